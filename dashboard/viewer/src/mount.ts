// What Streamlit asks of a component: a function that shows data in an element, again and again, and gives back what ends it.

interface Component {
  parentElement: HTMLElement | ShadowRoot;
}

interface View<C> {
  update(component: C): void;
  dispose(): void;
}

/**
 * The function that Streamlit calls: it makes one view of the element of class *name*, and brings it up to date at each call.
 *
 * Streamlit ends a call not only when the element leaves the page, but also when other data overtook it on its way. Then the view
 * is still needed, with what can be undone in it and what it has yet to send.
 */
export function mounted<C extends Component>(name: string, make: (root: HTMLElement) => View<C>): (component: C) => () => void {
  const views = new WeakMap<object, View<C>>();
  return (component) => {
    const { parentElement } = component;
    const root = parentElement.querySelector<HTMLElement>(`.${name}`);
    if (!root) throw new Error(`the page has no element of class ${name}`);
    const view = views.get(parentElement) ?? make(root);
    views.set(parentElement, view);
    view.update(component);
    return () => {
      if (root.isConnected || views.get(parentElement) !== view) return;
      views.delete(parentElement);
      view.dispose();
    };
  };
}

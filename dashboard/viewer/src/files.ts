// Files that Python put behind a URL: their name follows their content, so what was fetched once stays right.

const KEPT = 24;
const PATIENCE = 700; // milliseconds; a page that is just being run again may put a file back a moment later

/** Where Streamlit is, when it does not stand at the top of its server. */
const BASE = import.meta.url.includes("/_stcore/") ? import.meta.url.split("/_stcore/")[0] : "";

const fetched = new Map<string, Promise<ArrayBuffer>>();

export function address(url: string): string {
  return url.startsWith("/") ? BASE + url : url;
}

async function get(url: string): Promise<ArrayBuffer> {
  for (let attempt = 0; ; attempt++) {
    const answer = await fetch(address(url)).catch(() => null);
    if (answer?.ok) return answer.arrayBuffer();
    if (attempt === 2) throw new Error(answer ? `the server says ${answer.status}` : "the server does not answer");
    await new Promise((done) => setTimeout(done, PATIENCE));
  }
}

/** The bytes at `url`; the ones asked for last are kept. */
export function bytes(url: string): Promise<ArrayBuffer> {
  const found = fetched.get(url) ?? get(url);
  fetched.delete(url);
  fetched.set(url, found);
  found.catch(() => fetched.delete(url));
  for (const oldest of fetched.keys()) {
    if (fetched.size <= KEPT) break;
    fetched.delete(oldest);
  }
  return found;
}

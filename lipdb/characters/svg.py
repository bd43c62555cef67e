"""Whether an SVG is only a picture: what browsers could run in one, or fetch for it, is refused."""

from __future__ import annotations

import re
from pathlib import Path
from xml.parsers import expat

from lipdb.errors import MeshError

SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"
_DRAWN = (
    "svg g defs symbol use title desc metadata style path rect circle ellipse line polyline polygon text tspan linearGradient "
    "radialGradient stop clipPath mask pattern marker image filter feGaussianBlur feOffset feBlend feMerge feMergeNode "
    "feFlood feColorMatrix feComposite feDropShadow feMorphology feTurbulence feDisplacementMap switch view"
)
DRAWN = frozenset(_DRAWN.split())
EDITORS = (
    "http://www.inkscape.org/",
    "http://sodipodi.sourceforge.net/",
    "http://www.w3.org/1999/02/22-rdf-syntax-ns#",
    "http://creativecommons.org/ns#",
    "http://web.resource.org/cc/",
    "http://purl.org/dc/",
    "http://ns.adobe.com/",
    "http://www.bohemiancoding.com/",
    "http://www.figma.com/",
)
"""Beginnings of the namespaces in which drawing programs keep their own notes; browsers do nothing with them."""

_INSIDE = re.compile(r"\s*(?:#|data:image/(?:png|jpe?g);base64,)", re.IGNORECASE)
_REACHES_OUT = re.compile(r"@import|expression\(|javascript:|url\(\s*['\"]?(?!\s*(?:#|data:image/(?:png|jpe?g)))", re.IGNORECASE)
DEEPEST = 200


def check_svg(data: bytes, where: Path | str) -> None:
    """Raise `MeshError` for an SVG that is broken, has a script, or refers to anything outside of it."""
    _Check(where).read(data)


class _Check:
    def __init__(self, where: Path | str) -> None:
        self._where = where
        self._depth = 0
        self._text = ""

    def read(self, data: bytes) -> None:
        parser = expat.ParserCreate(namespace_separator=" ")
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._characters
        parser.StartDoctypeDeclHandler = self._doctype
        parser.EntityDeclHandler = lambda *_: self._refuse("entities of its own")
        parser.ProcessingInstructionHandler = lambda *_: self._refuse("a processing instruction")
        try:
            parser.Parse(data, True)
        except expat.ExpatError as error:
            raise MeshError(f"{self._where}: not an SVG ({error}); save it again as plain SVG") from error

    def _refuse(self, what: str) -> None:
        raise MeshError(f"{self._where}: this SVG has {what}; save it again as plain SVG")

    def _doctype(self, _name: str, _system: str | None, _public: str | None, internal: int) -> None:
        if internal:
            self._refuse("a document type of its own")

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        space, _, local = name.rpartition(" ")
        if self._depth == 0 and (space, local) != (SVG, "svg"):
            raise MeshError(f"{self._where}: not an SVG; save it again as plain SVG")
        self._depth += 1
        if self._depth > DEEPEST:
            self._refuse(f"more than {DEEPEST} elements in each other")
        if space == SVG and local not in DRAWN:
            self._refuse(f"an element {local}, which is more than a picture")
        if space != SVG and not space.startswith(EDITORS):
            self._refuse(f"an element {local} that is not SVG")
        self._text = ""
        for attribute, value in attributes.items():
            self._attribute(attribute, value)

    def _attribute(self, attribute: str, value: str) -> None:
        space, _, local = attribute.rpartition(" ")
        if local.lower().startswith("on") and space in ("", SVG):
            self._refuse(f"a script ({local})")
        if local.lower() in ("href", "src") and space in ("", XLINK, SVG) and not _INSIDE.match(value):
            self._refuse(f"a reference to something outside ({value[:40]})")
        if _REACHES_OUT.search(value):
            self._refuse(f"a reference to something outside ({local})")

    def _characters(self, text: str) -> None:
        self._text += text

    def _end(self, name: str) -> None:
        self._depth -= 1
        if name == f"{SVG} style" and (_REACHES_OUT.search(self._text) or "\\" in self._text):
            self._refuse("a style that refers to something outside")
        self._text = ""

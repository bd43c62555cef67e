"""SVG pictures that people upload are shown in browsers: anything that could run there, or fetch something, is refused."""

from pathlib import Path

import pytest

from lipdb.characters.svg import check_svg
from lipdb.errors import MeshError
from lipdb.paths import data_dir

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 9 9">'
INKSCAPE = """<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">
<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
 xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd" xmlns:xlink="http://www.w3.org/1999/xlink"
 inkscape:version="1.2" viewBox="0 0 9 9">
 <sodipodi:namedview id="base" inkscape:zoom="1"/>
 <defs><linearGradient id="a"><stop offset="0" style="stop-color:#f00"/></linearGradient></defs>
 <style>.lip { fill: url(#a); }</style>
 <use xlink:href="#a"/><image href="data:image/png;base64,iVBORw0KGgo="/>
 <path class="lip" inkscape:label="lip" d="M0 0L9 9" fill="url(#a)"/>
</svg>"""


def test_the_shipped_drawings_and_what_inkscape_writes_are_pictures() -> None:
    for file in sorted((data_dir("phonesets") / "characters" / "flat").glob("*.svg")):
        check_svg(file.read_bytes(), file)
    check_svg(INKSCAPE.encode(), "inkscape.svg")


@pytest.mark.parametrize(
    ("inside", "why"),
    [
        ("<script>alert(1)</script>", "element script"),
        ('<script xmlns="http://www.w3.org/1999/xhtml">alert(1)</script>', "element script that is not SVG"),
        ('<h:script xmlns:h="http://www.w3.org/1999/xhtml">alert(1)</h:script>', "element script that is not SVG"),
        ("<foreignObject><p/></foreignObject>", "element foreignObject"),
        ('<animate attributeName="href" to="javascript:alert(1)"/>', "element animate"),
        ('<set attributeName="onload" to="alert(1)"/>', "element set"),
        ('<a href="https://example.org"><path d=""/></a>', "element a"),
        ('<path onload="alert(1)" d=""/>', r"a script \(onload\)"),
        ('<path ONCLICK="alert(1)" d=""/>', r"a script \(ONCLICK\)"),
        ('<use href="https://example.org/a.svg#a"/>', "something outside"),
        ('<use xlink:href="javascript:alert(1)"/>', "something outside"),
        ('<image href="data:image/svg+xml;base64,PHN2Zz4="/>', "something outside"),
        ('<image href="/etc/passwd"/>', "something outside"),
        ('<path style="fill:url(https://example.org/x)" d=""/>', "something outside"),
        ("<style>@import 'https://example.org/x.css';</style>", "something outside"),
        ("<style>path { fill: url( 'https://example.org/x' ); }</style>", "something outside"),
        ("<style>p{fill:u\\72l(https://example.org/x)}</style>", "something outside"),
        ("<?xml-stylesheet href='x.xsl'?>", "processing instruction"),
        ("<g>" * 300 + "</g>" * 300, "more than 200"),
        ("<g>", "not an SVG"),
    ],
)
def test_scripts_and_references_are_refused(inside: str, why: str) -> None:
    with pytest.raises(MeshError, match=why) as refused:
        check_svg(f"{HEAD}{inside}</svg>".encode(), Path("A.svg"))
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "hello",
        "<html/>",
        "<svg/>",
        '<!DOCTYPE svg [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><svg xmlns="http://www.w3.org/2000/svg">&b;</svg>',
    ],
)
def test_what_is_no_svg_is_refused(text: str) -> None:
    with pytest.raises(MeshError, match="SVG"):
        check_svg(text.encode(), "A.svg")

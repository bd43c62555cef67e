"""``lipdb character``: whose faces there are, and new ones from files."""

from __future__ import annotations

from pathlib import Path

import click

from lipdb.cli.names import character_argument
from lipdb.cli.options import Group, Options, author_option, json_option, print_json, print_listing


@click.group(cls=Group, short_help="List, show and add characters.")
def character() -> None:
    """List, show and add characters.

    \b
    Examples:
      lipdb character add bob.glb --name bob
      lipdb character show bob
    """


@character.command("list")
@json_option
@click.pass_obj
def list_characters(options: Options, as_json: bool) -> None:
    """List the characters.

    \b
    Example:
      lipdb character list
    """
    with options.open() as db:
        print_listing(db.characters(), as_json=as_json, columns=("character", "title", "pose_set", "drawing", "source"))


@character.command("show")
@character_argument()
@json_option
@click.pass_obj
def show_character(options: Options, name: str, as_json: bool) -> None:
    """Show the character NAME: its pose set and how its poses move its own shapes.

    \b
    Example:
      lipdb character show crab
    """
    with options.open() as db:
        who = db.character(name)
        links = [link.to_row() for link in who.links]
        if as_json:
            print_json({"character": who.name, "title": who.title, "pose_set": who.pose_set, "drawing": who.drawing, "links": links})
        else:
            click.echo(f"{who.name}: {who.title} (pose set {who.pose_set}, drawing {who.drawing})")
            print_listing(links, as_json=False)


@character.command("add")
@click.argument("path", type=click.Path(path_type=Path))
@click.option("--name", required=True, help="What to call it: small letters, digits and _.")
@click.option("--title", default="", help="A line that says who it is.")
@author_option
@json_option
@click.pass_obj
def add_character(options: Options, path: Path, name: str, title: str, author: str, as_json: bool) -> None:
    """Add a character from PATH: a GLB or VRM file, a folder of OBJ files (one a shape) or of pictures.

    Its shapes are matched by name to the known sets; the doubtful and the missing ones are listed.

    \b
    Example:
      lipdb character add bob.glb --name bob
    """
    with options.open() as db:
        added = db.add_character(path, name=name, title=title, author=author)
        if as_json:
            print_json(added.to_json())
            return
        click.echo(f"added {name}: its shapes look like {added.shape_set}")
        print_listing(added.rows(), as_json=False, columns=("pose", "shape", "gain", "certainty", "comment"))

"""``lipdb completion``: print the script that makes a shell complete what is typed."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class


@click.command(short_help="Print the completion script of a shell.")
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
def completion(shell: str) -> None:
    """Print the script that makes SHELL complete lipdb's commands and options, and the names of languages and characters.

    \b
    Example:
      lipdb completion bash >> ~/.bashrc
    """
    from lipdb.cli import cli

    kind = get_completion_class(shell)
    assert kind is not None
    click.echo(kind(cli, {}, "lipdb", "_LIPDB_COMPLETE").source())

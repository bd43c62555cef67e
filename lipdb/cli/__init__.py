"""The command line, a thin mirror of the library.

Commands are imported when they are asked for, so that `lipdb --help` answers at once.
"""

from __future__ import annotations

import atexit
import gc
import os
import signal
import sys
from contextlib import suppress
from dataclasses import replace
from importlib import import_module
from types import FrameType
from typing import Any

import click

from lipdb.cli.options import Group, Options
from lipdb.errors import LipdbError, MissingToolError, OutputError

COMMANDS = {
    "say": ("lipdb.cli.speak:say", "Speak a sentence and write the moving face."),
    "sync": ("lipdb.cli.speak:sync", "Move a face to a recording that was aligned already."),
    "phones": ("lipdb.cli.inspect:phones", "Show the phones of a text and the common phones they map to."),
    "pairs": ("lipdb.cli.inspect:pairs", "Show the phone pairs of a text and where their curves come from."),
    "explain": ("lipdb.cli.inspect:explain", "Show what made each weight at one instant."),
    "language": ("lipdb.cli.language:language", "List, show, make and check languages."),
    "character": ("lipdb.cli.character:character", "List, show and add characters."),
    "coverage": ("lipdb.cli.coverage:coverage", "Count which phone pairs real text needs."),
    "curves": ("lipdb.cli.curves:curves", "Make the shared curves again from their parameters (targets/ and timing/)."),
    "db": ("lipdb.cli.db:db", "Look after the database: history, undo, text in and out."),
    "dashboard": ("lipdb.cli.dashboard:dashboard", "Open the dashboard in the browser."),
    "doctor": ("lipdb.cli.doctor:doctor", "Show what is installed, what works, and how to mend the rest."),
    "completion": ("lipdb.cli.completion:completion", "Print the completion script of a shell."),
}

EXIT_CODES = """\
\b
Exit codes:
  0  done                            5  unknown phone symbols
  1  another error                   6  somebody else saved first
  2  wrong use of the command        7  database locked, damaged, too old or new
  3  curated data are wrong          8  an optional part is not installed
  4  a file or text can't be used    9  a result can't be written
"""


class Commands(Group):
    """A group whose commands are imported on first use."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        """The names, in the order in which people need them."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """The command *cmd_name*, or None."""
        if cmd_name not in COMMANDS:
            return None
        module, _, attribute = COMMANDS[cmd_name][0].partition(":")
        command: click.Command = getattr(import_module(module), attribute)
        return command

    def invoke(self, ctx: click.Context) -> Any:
        """Run a command; when the reader of its output goes away (`lipdb … | head`), end at once and well."""
        try:
            return super().invoke(ctx)
        except BrokenPipeError:
            # What is still in the buffer must go somewhere when Python ends.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return None

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """List the commands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, help_text) for name, (_, help_text) in COMMANDS.items()])


@click.command(
    cls=Commands,
    epilog=EXIT_CODES,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110},
)
@click.option("--db", envvar="LIPDB_URL", metavar="FILE|URL", help="The database; the user's own by default.")
@click.option("--phonesets", envvar="LIPDB_PHONESETS", metavar="FOLDER", help="The curated text that fills a new database.")
@click.version_option(package_name="lipdb", message="lipdb %(version)s")
@click.pass_context
def cli(ctx: click.Context, db: str | None, phonesets: str | None) -> None:
    """Lip sync data for any language and any face.

    \b
    Examples:
      lipdb say "Hello world" --language en --character crab -o hello.mp4
      lipdb pairs "你好，世界" --language cmn
      lipdb doctor
    """
    ctx.obj = replace(ctx.obj or Options(), db=db, phonesets=phonesets)


def main() -> None:
    """Run the command line; every error that a user can cause is one line and an exit code."""
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)  # Windows has no SIGHUP; nohup ignores it, and so it stays.
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, _stop)
    # A command makes much that lives as long as its process: looking through that for garbage takes 0.1 s, and at the end 0.3 s more.
    gc.set_threshold(20_000, 50, 100)
    atexit.register(gc.freeze)
    try:
        cli(prog_name="lipdb", standalone_mode=False, obj=Options(alone=True))
    except click.Abort:
        sys.exit(130)
    except click.exceptions.NoArgsIsHelpError as error:
        error.show()
        sys.exit(error.exit_code)
    except click.ClickException as error:
        ctx = getattr(error, "ctx", None)
        what = " ".join(error.format_message().split()).removesuffix(".")
        end = " See" if what.endswith("?") else "; see"
        click.echo(f"lipdb: {what}{end} `{ctx.command_path if ctx else 'lipdb'} --help`", err=True)
        sys.exit(error.exit_code)
    except LipdbError as error:
        click.echo(f"lipdb: {error}", err=True)
        sys.exit(error.exit_code)
    except OSError as error:
        where = error.filename or "standard output"
        click.echo(f"lipdb: {where}: {error.strerror or error}; free some space, or look whether you may use it", err=True)
        if error.filename is None and sys.stdout is not None:
            # What could not be written would be tried again at the end, and change the exit code.
            with suppress(OSError):
                sys.stdout.close()
        sys.exit(OutputError.exit_code)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.partition(".")[0] == "lipdb":
            raise
        click.echo(f"lipdb: the package {error.name} is not installed; `lipdb doctor` says how to mend that", err=True)
        sys.exit(MissingToolError.exit_code)
    except MemoryError:
        click.echo("lipdb: this needs more memory than there is; give fewer frames a second, or a shorter line", err=True)
        sys.exit(LipdbError.exit_code)


def _stop(number: int, _frame: FrameType | None) -> None:
    """End as a program does that was told to (code 128 and the signal's number), after temporary files are cleared away."""
    sys.exit(128 + number)


__all__ = ["cli", "main"]

"""``lipdb dashboard``: the app in the browser."""

from __future__ import annotations

import click

from lipdb.cli.options import Options
from lipdb.network import is_local

PATIENCE = 3.0
"""Seconds that the server gets to end by itself."""


@click.command(short_help="Open the dashboard in the browser.")
@click.option("--port", type=click.IntRange(1, 65535), default=8501, show_default=True, help="Where the browser finds it.")
@click.option("--address", default="localhost", show_default=True, help="Who may reach it: 0.0.0.0 lets in the whole network.")
@click.option("--no-browser", is_flag=True, help="Open no browser.")
@click.pass_obj
def dashboard(options: Options, /, port: int, address: str, no_browser: bool) -> None:
    """Preview lines, edit curves, review coverage, add languages and characters, in the browser. Ctrl-C ends it.

    \b
    Example:
      lipdb dashboard --port 8600 --no-browser
    """
    import os
    import subprocess
    import sys
    from importlib.util import find_spec

    from lipdb.errors import InputError, MissingToolError
    from lipdb.paths import data_dir

    if find_spec("streamlit") is None:
        raise MissingToolError("the dashboard needs streamlit; install it with: pip install streamlit")
    if not _free(address, port):
        raise InputError(f"port {port} of {address} is taken or can't be used; name another one with --port")
    if not is_local(address):
        click.echo("lipdb: whoever reaches this address may edit, unless sign-in is configured (docs/dashboard.md)", err=True)
    with options.open():
        pass  # Makes or upgrades the database, and says here what is wrong with it.
    settings = {
        "server.port": port,
        "server.address": address,
        "server.headless": str(no_browser).lower(),
        "server.showEmailPrompt": "false",  # else the first start on a machine waits for an address to send news to
        "server.maxUploadSize": 32,
        "browser.gatherUsageStats": "false",
        "client.toolbarMode": "minimal",
        "runner.magicEnabled": "false",
        "server.fileWatcherType": "none",  # looking for changed sources costs the first visitor 0.1 s of a processor
    }
    chosen = {"LIPDB_URL": options.db, "LIPDB_PHONESETS": options.phonesets}
    arguments = [f"--{name}={value}" for name, value in settings.items()]
    folder = data_dir("dashboard")
    command = [sys.executable, str(folder / "serve.py"), "run", str(folder / "app.py"), *arguments]
    with subprocess.Popen(command, env={**os.environ, **{name: value for name, value in chosen.items() if value}}) as app:
        try:
            code = app.wait()
        except BaseException:
            # The server waits for open pages to go away; nothing of theirs is lost when it does not.
            app.terminate()
            try:
                app.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                app.kill()
            raise
    sys.exit(code)


def _free(address: str, port: int) -> bool:
    """Whether a server can listen there."""
    import socket

    try:
        family = socket.getaddrinfo(address, port, type=socket.SOCK_STREAM)[0][0]
        with socket.socket(family, socket.SOCK_STREAM) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((address, port))
    except OSError:
        return False
    return True

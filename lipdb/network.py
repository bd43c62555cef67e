"""Addresses that a server can listen on."""

from __future__ import annotations

LOCAL = ("localhost", "127.0.0.1", "::1")


def is_local(address: str | None) -> bool:
    """Whether nobody but this machine reaches *address*; None is every address that the machine has."""
    return address in LOCAL

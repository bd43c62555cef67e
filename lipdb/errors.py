"""Every error that lipdb raises on purpose, and the exit code each one ends the command line with."""

from __future__ import annotations


class LipdbError(Exception):
    """Base of every error that lipdb raises on purpose.

    The message is one line: what is wrong, where, and what to do about it.

    * LipdbError                 exit code 1
      - DataError              3 something in phonesets/ is wrong
        + PhonesetError          a table of phones, poses, links or sources
        + CurveError             a curve, or a parameter that curves are made from
      - InputError             4 a file or a text from outside can't be used
        + ScheduleError          timed phones that overlap, run backwards or are not numbers
        + MeshError              a mesh without morph targets, or a broken one
        + UnknownSymbolError   5 symbols that no phone set knows
      - ConflictError          6 somebody else saved first
      - StoreError             7 the database is locked, damaged or not there
        + SchemaVersionError     the database is older or newer than this program
      - MissingToolError       8 an optional part is not installed
      - OutputError            9 a result can't be written
    """

    exit_code = 1


class DataError(LipdbError):
    """Something in phonesets/ is wrong."""

    exit_code = 3


class PhonesetError(DataError):
    """A table of phones, poses, links or sources is wrong."""


class CurveError(DataError):
    """A curve, or a parameter that curves are made from, is wrong."""


class InputError(LipdbError):
    """A file or a text from outside can't be used."""

    exit_code = 4


class ScheduleError(InputError):
    """Timed phones overlap, run backwards or are not numbers."""


class MeshError(InputError):
    """A mesh has no morph targets, or is broken."""


class UnknownSymbolError(InputError):
    """Symbols stand in a text or a recording that no phone set knows."""

    exit_code = 5


class ConflictError(LipdbError):
    """Somebody else saved a newer revision first."""

    exit_code = 6


class StoreError(LipdbError):
    """The database is locked, damaged or not there."""

    exit_code = 7


class SchemaVersionError(StoreError):
    """The database is older or newer than this program."""


class MissingToolError(LipdbError):
    """An optional part is not installed."""

    exit_code = 8


class OutputError(LipdbError):
    """A result can't be written."""

    exit_code = 9

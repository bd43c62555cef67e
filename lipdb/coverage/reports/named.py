"""What a person means by a name: a scan's file, somebody's table of counts, or published frequencies."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from lipdb.coverage.reports.frequency import Frequency
from lipdb.errors import InputError

if TYPE_CHECKING:
    import pyarrow as pa

    from lipdb.curated.tsv import Records
    from lipdb.database import Database

LEFT, RIGHT, COUNT = ("left", "from"), ("right", "to"), ("count", "percent")
DELIMITERS = {".csv": ",", ".tsv": "\t"}


def published(records: Records) -> dict[str, str]:
    """The published frequencies in the curated data: name to table."""
    return {path.split("/")[1].removesuffix(".tsv"): path for path in records if path.startswith("frequencies/")}


def read_frequency(path: Path, *, silence: bool = True) -> Frequency:
    """The frequency in a scan's Parquet file, or in a .csv or .tsv with the columns left, right (or from, to) and count.

    Raises `InputError` for files that are none of these.
    """
    kind = path.suffix.lower()
    if kind not in (".parquet", *DELIMITERS):
        raise InputError(f"{path}: no table of pairs; give the .parquet of a scan, or a .csv or .tsv with left, right and count")
    try:
        table = _read(path, kind)
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such file; `lipdb coverage list` shows the scans") from None
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: can't be read as a table ({str(error).splitlines()[0]}); give the file that a scan wrote") from error
    names = [next((name for name in choices if name in table.column_names), "") for choices in (LEFT, RIGHT, COUNT)]
    if not all(names):
        raise InputError(f"{path}: has the columns {', '.join(table.column_names)}; a table of pairs has left, right and count")
    try:
        summed = table.group_by(names[:2]).aggregate([(names[2], "sum")])
    except NotImplementedError:
        raise InputError(f"{path}: column {names[2]} holds something that is no number; give the file that a scan wrote") from None
    rows = zip(*(summed.column(k).to_pylist() for k in range(3)), strict=True)
    return Frequency.of(rows, silence=silence, percent=names[2] == "percent").required(str(path))


def _read(path: Path, kind: str) -> pa.Table:
    """The columns of *path* that matter."""
    if kind == ".parquet":
        import pyarrow.parquet as pq

        return pq.read_table(path, columns=[name for name in pq.read_schema(path).names if name in (*LEFT, *RIGHT, *COUNT)])
    from pyarrow import csv

    return csv.read_csv(path, parse_options=csv.ParseOptions(delimiter=DELIMITERS[kind]))


def named_frequency(db: Database, name: str, *, silence: bool = True) -> Frequency:
    """The frequency that *name* means: a file, the number of a scan in `lipdb coverage list`, or published frequencies by name."""
    known = published(db.records)
    if name in known and not Path(name).exists():
        rows = db.records[known[name]].values()
        return Frequency.of(((row["left"], row["right"], float(row["percent"])) for row in rows), silence=silence, percent=True)
    return read_frequency(_file(db, name), silence=silence)


def language_of(db: Database, name: str) -> str:
    """The language of the scan that *name* means, as in `named_frequency`; nothing where nobody says."""
    path = _file(db, name)
    if path.suffix.lower() != ".parquet" or not path.is_file():
        return ""
    from lipdb.coverage.result import read_result

    try:
        return str(read_result(path).get("language", ""))
    except (OSError, ValueError):
        return ""  # whoever reads its table says what is wrong


def _file(db: Database, name: str) -> Path:
    """The file that *name* is, or that the scan of this number wrote. Raises `InputError` for a number that no scan has."""
    path = Path(name)
    if path.exists() or not name.isdecimal():
        return path
    scan = next((scan for scan in db.store.scans() if name == str(scan.id)), None)
    if scan is None:
        raise InputError(f"there is no scan {name}; `lipdb coverage list` shows the scans")
    return Path(scan.path)


def newest_scan(db: Database, language: str) -> str:
    """The file of the newest scan of *language*. Raises `InputError` when there is none."""
    scans = db.store.scans(language)
    if not scans:
        raise InputError(f"there is no scan of {language!r} yet; count some text with `lipdb coverage scan FILE --language {language}`")
    return scans[0].path

"""Count words, and which labels meet between them, with Polars or DuckDB: peers of the fast count, see ``coverage_speed.py``.

usage: python benchmarks/coverage_peers.py polars|duckdb TEXT LEXICON

LEXICON is Parquet with the columns word, first and last.
"""

from __future__ import annotations

import sys

WORD = r"[\p{L}\p{M}\p{N}'’]+"


def polars(text: str, lexicon: str) -> tuple[int, int]:
    """How many different words there are, and how many pairs of labels at their edges."""
    import polars as pl

    lines = pl.scan_csv(text, has_header=False, new_columns=["line"], separator="\x01", quote_char=None, schema={"line": pl.String})
    words = lines.with_row_index("at").select("at", word=pl.col("line").str.extract_all(WORD)).explode("word").drop_nulls()
    known = words.join(pl.scan_parquet(lexicon), on="word", how="left", maintain_order="left")
    edges = known.select("last", right=pl.when(pl.col("at").shift(-1) == pl.col("at")).then(pl.col("first").shift(-1)))
    counted, met = pl.collect_all([words.group_by("word").len(), edges.drop_nulls().group_by("last", "right").len()])
    return len(counted), len(met)


def duckdb(text: str, lexicon: str) -> tuple[int, int]:
    """The same."""
    import duckdb

    database = duckdb.connect()
    database.execute("SET preserve_insertion_order = false")
    database.execute(
        f"""
        CREATE TABLE words AS
        SELECT nr, generate_subscripts(found, 1) AS place, unnest(found) AS word FROM (
            SELECT row_number() OVER () AS nr, regexp_extract_all(line, $word) AS found
            FROM read_csv('{text}', columns = {{'line': 'VARCHAR'}}, delim = '\x01', quote = '', escape = '', header = false)
        )
        """,
        {"word": WORD},
    )
    counted = database.execute("SELECT word, count(*) FROM words GROUP BY word").fetchall()
    met = database.execute(
        f"""
        SELECT a.last, b.first, count(*) FROM words v JOIN words w ON v.nr = w.nr AND v.place + 1 = w.place
        JOIN '{lexicon}' a ON a.word = v.word JOIN '{lexicon}' b ON b.word = w.word GROUP BY ALL
        """
    ).fetchall()
    return len(counted), len(met)


if __name__ == "__main__":
    print(*{"polars": polars, "duckdb": duckdb}[sys.argv[1]](*sys.argv[2:]))

"""The tables of the store. They hold rows of curated data as text, so they are the same for every kind of fact.

``record`` is the present, ``revision`` and ``change`` are how it came to be, ``shipped`` is the text that shipped when
it was last merged: the base of the three-way merge. ``scan`` says which corpora were counted, and where the counts are. Keys
are JSON lists and cells JSON objects, as text, so that SQLite and PostgreSQL store, compare and return the same thing.
"""

from __future__ import annotations

import sqlalchemy as sa

SCHEMA = "0003"
"""The migration that this program works with. Older databases are upgraded, newer ones are refused."""

OLDER_SCHEMAS = ("0001", "0002")

NAMING = {
    "ix": "ix_%(table_name)s_%(column_0_N_name)s",
    "uq": "uq_%(table_name)s_%(column_0_N_name)s",
    "ck": "ck_%(table_name)s_%(constraint_name)s",
    "fk": "fk_%(table_name)s_%(column_0_N_name)s_%(referred_table_name)s",
    "pk": "pk_%(table_name)s",
}

metadata = sa.MetaData(naming_convention=NAMING)

revision = sa.Table(
    "revision",
    metadata,
    sa.Column("id", sa.Integer, primary_key=True, autoincrement=False),
    sa.Column("author", sa.Text, nullable=False),
    sa.Column("time", sa.Text, nullable=False),
    sa.Column("note", sa.Text, nullable=False),
)

record = sa.Table(
    "record",
    metadata,
    sa.Column("id", sa.Integer, primary_key=True),
    sa.Column("path", sa.Text, nullable=False),
    sa.Column("key", sa.Text, nullable=False),
    sa.Column("cells", sa.Text, nullable=False),
    sa.Column("revision", sa.Integer, sa.ForeignKey("revision.id"), nullable=False),
    sa.UniqueConstraint("path", "key"),
)

change = sa.Table(
    "change",
    metadata,
    sa.Column("id", sa.Integer, primary_key=True),
    sa.Column("revision_id", sa.Integer, sa.ForeignKey("revision.id"), nullable=False),
    sa.Column("path", sa.Text, nullable=False),
    sa.Column("key", sa.Text, nullable=False),
    sa.Column("before", sa.Text),
    sa.Column("after", sa.Text),
    sa.CheckConstraint("before IS NOT NULL OR after IS NOT NULL", name="something"),
    sa.UniqueConstraint("revision_id", "path", "key"),
    sa.Index(None, "path", "key"),
)

shipped = sa.Table(
    "shipped",
    metadata,
    sa.Column("path", sa.Text, primary_key=True),
    sa.Column("key", sa.Text, primary_key=True),
    sa.Column("cells", sa.Text, nullable=False),
)

fact = sa.Table(
    "fact",
    metadata,
    sa.Column("name", sa.Text, primary_key=True),
    sa.Column("value", sa.Text, nullable=False),
)

scan = sa.Table(
    "scan",
    metadata,
    sa.Column("id", sa.Integer, primary_key=True),
    sa.Column("time", sa.Text, nullable=False),
    sa.Column("language", sa.Text, nullable=False, index=True),
    sa.Column("mode", sa.Text, nullable=False),
    sa.Column("corpus", sa.Text, nullable=False),
    sa.Column("content", sa.Text, nullable=False),
    sa.Column("counter", sa.Text, nullable=False),
    sa.Column("mapping", sa.Text, nullable=False),
    sa.Column("revision", sa.Integer, sa.ForeignKey("revision.id"), nullable=False),
    sa.Column("path", sa.Text, nullable=False),
    sa.Column("totals", sa.Text, nullable=False),
)

version = sa.Table("alembic_version", sa.MetaData(), sa.Column("version_num", sa.String(32), primary_key=True))
"""Alembic's own table: read here so that opening a database needs no Alembic."""

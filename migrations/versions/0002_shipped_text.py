"""What the shipped text said when it was last merged: the base of the three-way merge"""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"


def upgrade():
    op.create_table(
        "shipped",
        sa.Column("path", sa.Text(), nullable=False),
        sa.Column("key", sa.Text(), nullable=False),
        sa.Column("cells", sa.Text(), nullable=False),
        sa.PrimaryKeyConstraint("path", "key", name=op.f("pk_shipped")),
    )
    op.create_table(
        "fact",
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("value", sa.Text(), nullable=False),
        sa.PrimaryKeyConstraint("name", name=op.f("pk_fact")),
    )
    # Revision 1 is the one that filled the database from the shipped text.
    op.execute("INSERT INTO shipped (path, key, cells) SELECT path, key, after FROM change WHERE revision_id = 1")


def downgrade():
    op.drop_table("fact")
    op.drop_table("shipped")

"""Everything that makes a schedule: voices that speak text, readers of recordings aligned already."""

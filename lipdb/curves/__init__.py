"""Blend curves: how one is written, where the winning one is found, how the shared ones are made."""

"""From timed common phones to pose weights. numpy only."""

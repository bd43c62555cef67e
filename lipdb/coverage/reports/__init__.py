"""What counts of real text say: frequencies, gaps, selections, comparisons."""

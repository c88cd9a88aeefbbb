"""Speed, as ratios against something measured in the same run; each module's `run()` gives its figures."""

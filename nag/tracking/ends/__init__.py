"""Ends of paths in as many digits as they need.

What a straight run in doubles leaves doubtful is followed in the logarithm of t, from a point
where it was safe. In order of reading: `follow` (what becomes of the paths), `runs` (batches of
them, and with `exponent_range` those that leave the range of doubles), `end_run` (one step for
eight paths, with `corrector`, `evaluation`, `linear_algebra`, `kept_points`, `branch`), `inclusion`
(proof that an end is regular), `limits` (other ends, and whether the exact equations agree, to as
many digits as `evidence` says), `initial_forms` (whether those at infinity are ends at all).
"""

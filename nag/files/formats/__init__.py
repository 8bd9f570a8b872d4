"""Polynomial systems in the files of other programs, read and written.

Read in this order, bottom-up: `source` (a text that knows lines and columns, and the system that it
is read to), then a file for each program: `plain` (a polynomial a line), `phcpack`, `bertini`,
`macaulay2`, `singular`, `julia`; `words` that are no names there; `writing` on these (with sympy
and LaTeX, which are written only); `reading` tells by a file's content which it is.

To add a format, write such a file with ``read`` or ``write``, and enter it in `reading.READERS` or
`writing.WRITERS` and in `docs/formats.md`.
"""

# Formats that are read: TOML for all kinds of cases, the others for polynomial systems,
# and those of robots (`nag.files.robots`).
ROBOTS = ("urdf", "mjcf")
READ = ("toml", "bertini", "phc", "m2", "singular", "hc", "text", *ROBOTS)
# Formats that are written.
WRITTEN = ("bertini", "phc", "m2", "singular", "text", "sympy", "hc", "latex")

"""Text for people: aligned columns for a terminal, HTML tables for a notebook.

`table` knows nothing of what stands in the cells. `nag.algebra.system`, `nag.solving.shown` and
`nag.witness.shown` say what the objects of their packages show at the prompt; `nag.report` writes
the answers of the commands.
"""

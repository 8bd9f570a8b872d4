"""Text for people and programs: columns for a terminal, HTML tables for a notebook, JSON.

`table` knows nothing of what stands in the cells, and `json_text` nothing of what is exported.
`nag.algebra.system`, `nag.solving.shown` and `nag.witness.shown` say what the objects of their
packages show at the prompt; `nag.report` writes the answers of the commands.
"""

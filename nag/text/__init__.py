"""Text for people and programs: columns for a terminal, HTML tables for a notebook, JSON.

`table` knows nothing of what stands in the cells, `json_text` nothing of what is exported, and
`progress` and `progress_line`, which shows it, nothing of what is done.
`nag.algebra.system`, and `shown` in `nag.numerics`, `nag.solving`, `nag.witness` and
`nag.mechanism`, say what the objects of their packages show at the prompt; `nag.report` writes the
answers of the commands.
"""

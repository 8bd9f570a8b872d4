"""Files: cases that are read, exports that are written and read back.

Read in this order: `cases` on `case_table` and `case_family` (TOML in), `problem` (what a case
asks); `export` and `solutions_export` on `json_text` and `json_values`, with their schemas in
``schema/``; `written_file` (checked first, replaced in one step).
"""

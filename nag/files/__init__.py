"""Files: cases that are read, exports that are written and read back.

Read in this order, top-down: `cases` on `case_table` (TOML in), with a file for each kind
(`mechanism_case`, `framework_case`, `dh_case`, `linkage_case`, `robot_case`) and `case_family`;
`case_writing` (the same written); the package `formats` (systems in the files of other programs,
read and written), and `robots` (URDF and MJCF); `member_values` (parameters of a family's members);
`export_case` (the equations that an export answers) on `export` and `solutions_export`;
`points_export` (samples, singular points), `answer_export` (other answers, which are written only)
and `certificate_export`; all these on `json_values` and
`json_schema` (what is read fits its schema); `written_file` (checked first, replaced in one step).
"""

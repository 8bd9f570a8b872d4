"""Results as text: pure functions from results to lines.

Read `table` first (rows, columns, remarks), then `answer` and `solutions`, each one command's text;
`agreement` compares an answer with what a case says is known.
"""

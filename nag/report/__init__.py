"""Results as text: pure functions from results to lines, and `elimination` to its document as well.

Top-down: read `answer` and `solutions` first, each one command's text, on `nag.witness.shown` (the
table of components) and `model` (of a mechanism); `agreement` compares an answer with what a case
says is known.
"""

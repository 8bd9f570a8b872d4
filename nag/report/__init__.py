"""Results as text: pure functions from several results to lines; one says its own rows itself.

Top-down: read `answer` and `solutions` first, each one command's text, on `nag.witness.shown` (the
table of components) and `model` (of a mechanism); `agreement` compares an answer with what a case
says is known.
"""

"""Arithmetics for the ends of paths, each a module of the same functions on lanes.

`double_double`, `quad_double` and `octuple_double`: a real number is a tuple of ``WORDS`` lanes,
the largest part first, each at most half a unit in the last place of the one before. A complex
number (`complex_numbers`) is a pair of them. Everything rests on two transformations in
`error_free`, which hold only as long as nothing is reassociated or contracted.
"""

"""Arithmetics, of so many words: objects with the same methods on lanes.

Top-down: `doubles` are for whole paths, the others for their ends. `double_double` has two words,
`many_words` four or eight: a real number is a tuple of ``words`` lanes, the largest part first,
each at most half a unit in the last place of the one before. A complex number (`complex_numbers`)
is a pair of them, and what kernels are given is an arithmetic of these. Everything rests on two
transformations in `error_free`, which hold only as long as nothing is reassociated or contracted.
"""

"""Arithmetics for the ends of paths, each a module of the same functions on lanes.

A real number is a tuple of ``WORDS`` lanes, the largest part first, each at most half a unit in
the last place of the one before; a complex number is a pair of them. Everything rests on two
error-free transformations, which hold only as long as nothing is reassociated or contracted.
"""

"""The statements of the founding papers, each tested; decompositions against their components.

Bottom-up: read `statement`, then `identities` (formulas) and `rings` (ideals); one file a subject
lists its statements; `four_way` and `mechanisms` compare decompositions with the papers'
components; `subjects` has everything.
"""

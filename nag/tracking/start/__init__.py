"""Start systems: solved systems from which paths lead to all isolated solutions of a target."""

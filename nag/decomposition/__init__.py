"""Irreducible decomposition of solution sets into witness sets."""

"""Mechanisms: bodies and joints, and the smallest polynomial systems that model them."""

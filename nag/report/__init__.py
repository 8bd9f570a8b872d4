"""Tables, JSON and other ways to show a result."""

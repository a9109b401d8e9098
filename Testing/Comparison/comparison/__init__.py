"""What Testing/Comparison/table1 is made of."""

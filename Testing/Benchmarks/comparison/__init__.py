"""What Testing/Benchmarks/table1 is made of."""

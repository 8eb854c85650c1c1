// Nothing: this target is there for what it precompiles.

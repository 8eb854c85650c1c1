// Nothing: the target needs a source, beside the headers that it precompiles.

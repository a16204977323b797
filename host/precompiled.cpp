// Nothing: the targets that only precompile headers need a file to compile.

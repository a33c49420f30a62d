// The precompiled headers of all tests belong to a target; this is its source.

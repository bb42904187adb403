// Nothing: meninas_headers has precompiled headers alone (ProjectOptions.cmake), and a library needs a source.

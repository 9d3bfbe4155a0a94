# SPDX-License-Identifier: Apache-2.0
# Doxygen reads each header through this: sed -z -E -f tools/doxygen_filter.sed HEADER. No line is added or taken away.
# Doxygen documents a file's functions where the file has a comment; the licence line becomes one.
s|^// SPDX[^\n]*|/** @file */|
# A comment right before the namespace is about the file.
s|\n\n((///[^\n]*\n)+namespace dismantle)|\n/// @file\n\1|
# A defaulted comparison says everything.
s#friend [^\n]*operator(==|<=>)\([^\n]*= default;#/** Compares member by member. */ &#g

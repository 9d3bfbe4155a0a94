#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_quotes.py DOCUMENT FOLDER: checks that every C++ block of the document is in a source of the folder, line by line."""
import pathlib
import re
import sys

document, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
sources = [source.read_text(encoding="utf-8") for source in sorted(folder.glob("*.cpp"))]
blocks = re.findall(r"```cpp\n(.*?)```", document.read_text(encoding="utf-8"), re.DOTALL)
missing = [block for block in blocks if not any(block in source for source in sources)]
for block in missing:
    print(f"{document.name} shows what no example has:\n{block}")
print(f"{document.name}: {len(blocks)} blocks, {len(missing)} of them nowhere in {folder.name}/")
sys.exit(1 if missing or not blocks else 0)

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes one program of all blocks of C++ in the documentation: write_cpp.py ROOT PROGRAM

Each block becomes a function, with the variables of BlockGivens.h around it. Blocks that are saved
to a file are whole programs, and built where the page says how.
"""

import pathlib
import re
import sys

from markdown_pages import pages

FUNCTION = """
void {name}(const BlockGivens& givens)
{{
  const auto& [reader, coarse, scan, mesh] = givens;
  {{
#line {line} "{page}"
{text}  }}
}}
"""
MAIN = """
int main()
{{
{calls}}}
"""


def main():
    root, program = map(pathlib.Path, sys.argv[1:])
    functions, calls = "", ""
    for page in pages(root):
        for block in page.blocks:
            if block.language == "cpp" and not block.is_saved:
                name = re.sub(r"\W", "_", f"{page.name}_{block.line}")
                text = block.text
                functions += FUNCTION.format(name=name, line=block.line + 1, page=page.path, text=text)
                calls += f'  std::cout << "{page.name}:{block.line}" << std::endl;\n'
                calls += f"  {name}(BlockGivens::make());\n"
    program.write_text('#include "BlockGivens.h"\n' + functions + MAIN.format(calls=calls), encoding="utf-8")


if __name__ == "__main__":
    main()

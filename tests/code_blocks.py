#!/usr/bin/env python3
"""Sees to it that the code of a page is that of programs which the suite builds and runs.

    code_blocks.py SOURCE PAGE...

Every block of C++, C, Python or CMake must stand in one of the files of its language, line by line
and indented alike. Exits 1, showing the first line that does not, where one is nowhere.
"""
import pathlib
import re
import sys
import textwrap

FILES = {"cpp": "examples/*.cpp", "c": "examples/*.c", "python": "examples/*.py",
         "cmake": "tests/consumer/*/CMakeLists.txt"}


def stands_in(block, lines):
    """How many of the block's lines stand in the file at most, one after the other."""
    most = 0
    for start in range(len(lines)):
        here = textwrap.dedent("\n".join(lines[start:start + len(block)])).split("\n")
        same = 0
        while same < len(block) and same < len(here) and block[same] == here[same]:
            same += 1
        most = max(most, same)
    return most


def main():
    source, pages = pathlib.Path(sys.argv[1]), sys.argv[2:]
    found = 0
    for page in pages:
        text = pathlib.Path(page).read_text(encoding="utf-8")
        for language, code in re.findall(r"^```(\w+)\n(.*?)^```$", text, re.M | re.S):
            if language not in FILES:
                continue
            found += 1
            block = code.rstrip("\n").split("\n")
            files = sorted(source.glob(FILES[language]))
            best = max(files, key=lambda f: stands_in(block, f.read_text().split("\n")))
            most = stands_in(block, best.read_text().split("\n"))
            if most < len(block):
                sys.exit(f"{page}: this line of a block of {language} stands in no program "
                         f"(nearest: {best.relative_to(source)}):\n    {block[most]}")
    if not found:
        sys.exit("no code found")
    print(f"{found} blocks of code stand in programs that are built and run")


main()

#!/usr/bin/env python3
"""Checks that examples/csharp/Glissade.cs declares the functions of capi/glissade.h with as many arguments, and the members
of its structs in the same order, with the same types and lengths."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def words_of(path):
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", (ROOT / path).read_text(), flags=re.DOTALL)


def functions_of(text, marker):
    found = re.findall(marker + r"[\w\s*]*?\b(glissade_\w+)\(([^)]*)\)", text)
    return {name: 0 if arguments.strip() in ("", "void") else arguments.count(",") + 1 for name, arguments in found}


CSHARP_TYPES = {"double": "double", "int32_t": "int", "int64_t": "long", "uint64_t": "ulong", "size_t": "ulong"}
LENGTHS = {"GLISSADE_JOINTS": "Glissade.Joints", "GLISSADE_MAX_PARTS": "4", "GLISSADE_MAX_HANDS": "4",
           "GLISSADE_MAX_CONTACTS": "24"}


def members_in_c(body):
    """(C# type, name, length of the array or None) of each member."""
    for statement in filter(str.strip, body.split(";")):
        kind, variables = re.fullmatch(r"\s*((?:const )?\w+\s*\*?)(.*)", statement, re.DOTALL).groups()
        for variable in variables.split(","):
            name, length = re.fullmatch(r"\s*(\w+)(?:\[(\w+)\])?\s*", variable).groups()
            kind_in_csharp = "IntPtr" if "*" in kind else CSHARP_TYPES.get(kind.strip(), kind.strip())
            yield kind_in_csharp, name, LENGTHS.get(length, length)


def members_in_csharp(body):
    for statement in filter(str.strip, body.split(";")):
        length = re.search(r"SizeConst = ([\w.]+)", statement)
        kind, variables = re.fullmatch(r"(?:\s*\[[^\]]*\])?\s*public (\w+)(?:\[\])?\s(.*)", statement, re.DOTALL).groups()
        for name in variables.split(","):
            yield kind, name.strip(), length and length[1]


class Declarations(unittest.TestCase):
    header = words_of("capi/glissade.h")
    csharp = words_of("examples/csharp/Glissade.cs")

    def test_functions_have_as_many_arguments(self):
        of_header = functions_of(self.header, "GLISSADE_API ")
        self.assertGreater(len(of_header), 40)
        self.assertEqual(functions_of(re.sub(r"\[Out\]", "", self.csharp), "static extern "), of_header)

    def test_structs_have_the_same_members(self):
        of_header = dict(re.findall(r"typedef struct (\w+) \{(.*?)\} \w+;", self.header, re.DOTALL))
        of_csharp = dict(re.findall(r"public struct (\w+) \{([^}]*)\}", self.csharp, re.DOTALL))
        self.assertEqual(set(of_header), set(of_csharp))
        for name, body in of_header.items():
            self.assertEqual(list(members_in_csharp(of_csharp[name])), list(members_in_c(body)), name)


if __name__ == "__main__":
    unittest.main()

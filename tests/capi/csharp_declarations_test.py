#!/usr/bin/env python3
"""Checks that examples/csharp/Glissade.cs declares the functions of capi/glissade.h with as many arguments, and the members
of its structs in the same order."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def words_of(path):
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", (ROOT / path).read_text(), flags=re.DOTALL)


def functions_of(text, marker):
    found = re.findall(marker + r"[\w\s*]*?\b(glissade_\w+)\(([^)]*)\)", text)
    return {name: 0 if arguments.strip() in ("", "void") else arguments.count(",") + 1 for name, arguments in found}


def members_of(body):
    body = re.sub(r"\[[^\]]*\]", "", body)
    statements = (statement for statement in body.split(";") if statement.strip())
    return [re.findall(r"\w+", variable)[-1] for statement in statements for variable in statement.split(",")]


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
            self.assertEqual(members_of(of_csharp[name]), members_of(body), name)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
"""Breaks one rule of the architecture at a time, in a copy of the sources, and expects check_architecture to say so."""

import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
CHECK = REPOSITORY / "scripts" / "check_architecture"
LIMIT = 60


def copy_sources(target):
    for path in REPOSITORY.glob("*/CMakeLists.txt"):
        for pattern in ("*.h", "*.cpp", "*.lcm", "CMakeLists.txt"):
            for file in path.parent.rglob(pattern):
                copy = target / file.relative_to(REPOSITORY)
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file, copy)
    (target / "docs").mkdir()
    shutil.copyfile(REPOSITORY / "docs" / "types.md", target / "docs" / "types.md")


def run_check(root):
    return subprocess.run([CHECK, root], capture_output=True, text=True, check=False)


class CheckArchitecture(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.root = pathlib.Path(folder.name)
        copy_sources(cls.root)
        cls.before = run_check(cls.root).stdout.splitlines()

    def write(self, file, text):
        """Writes a file, which may be new, and restores what was there after the test."""
        path = self.root / file
        if path.exists():
            self.addCleanup(path.write_text, path.read_text())
        elif path.parent.exists():
            self.addCleanup(path.unlink)
        else:
            path.parent.mkdir()
            self.addCleanup(shutil.rmtree, path.parent)
        path.write_text(text)

    def include(self, file, *names):
        """Adds includes to the end of a file, which may be new."""
        path = self.root / file
        self.write(file, (path.read_text() if path.exists() else "") + "".join(f"#include {name}\n" for name in names))

    def list_header(self, component, header):
        cmake = f"{component}/CMakeLists.txt"
        self.write(cmake, (self.root / cmake).read_text().replace("HEADERS\n", f"HEADERS\n    {header}\n", 1))

    def expect(self, file, *words):
        """The status is 1, and one new line is FILE:LINE: SENTENCE. with all these words."""
        result = run_check(self.root)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        new = [line for line in result.stdout.splitlines() if line not in self.before]
        found = [line for line in new if re.match(rf"{file}:\d+: \w.*\.$", line) and all(word in line for word in words)]
        self.assertEqual(len(found), 1, "\n".join(new) + result.stderr)

    def test_cycle_of_pairs(self):
        self.include("collision/tree/one.h", '"tree/two.h"')
        self.include("collision/tree/two.cpp", '"tree/two.h"', '"tree/one.h"')
        self.write("collision/tree/two.h", "")
        self.expect("collision/tree/one.h", "collision/tree/one -> collision/tree/two -> collision/tree/one",
                    "collision/tree/one.h:1", "collision/tree/two.cpp:2")

    def test_cycle_of_rooms(self):
        self.write("devices/first/one.h", "")
        self.write("devices/second/one.h", "")
        self.include("devices/first/two.h", '"second/one.h"')
        self.include("devices/second/two.h", '"first/one.h"')
        self.expect("devices/first/two.h", "devices/first -> devices/second -> devices/first")

    def test_cycle_through_the_public_face(self):
        self.include("devices/first/one.h", "<glissade/devices/glove_device.h>")
        self.include("devices/glove_device.h", '"first/one.h"')
        self.expect("devices/glove_device.h", "devices (public headers) -> devices/first -> devices (public headers)")

    def test_cycle_of_components(self):
        self.include("geometry/exact/one.cpp", "<glissade/collision/world.h>")
        self.expect("collision/.*", "collision -> geometry -> collision", "geometry/exact/one.cpp:1")

    def test_component_that_is_not_declared(self):
        self.include("realtime/clock.cpp", "<glissade/geometry/triangle_mesh.h>")
        self.expect("realtime/clock.cpp", "geometry", "DEPENDS of realtime")

    def test_public_header_that_includes_a_room(self):
        self.write("collision/tree/one.h", "")
        self.include("collision/world.h", '"tree/one.h"')
        self.expect("collision/world.h", "public header must not include collision/tree/one.h")

    def test_public_header_that_includes_base(self):
        self.include("collision/world.h", "<glissade/base/require.h>")
        self.expect("collision/world.h", "public header must not include base/require.h")

    def test_the_export_header_is_for_public_headers(self):
        self.include("realtime/clock.h", "<glissade/base/export.h>")
        self.assertNotIn("realtime/clock.h", run_check(self.root).stdout)

    def test_room_of_another_component(self):
        self.write("collision/tree/one.h", "")
        quoted, angled = '"tree/one.h"', "<glissade/collision/tree/one.h>"
        for file, name in (("haptics/sliding/one.cpp", quoted), ("tests/haptics/one.cpp", quoted),
                           ("bench/haptics/one.cpp", angled), ("apps/one.cpp", angled)):
            with self.subTest(file=file):
                self.include(file, name)
                self.expect(file, "collision/tree/one.h is private to collision")

    def test_tests_may_enter_the_rooms_of_their_component(self):
        self.write("collision/tree/one.h", "")
        self.include("tests/collision/one.cpp", '"tree/one.h"')
        self.assertEqual(run_check(self.root).stdout.count("/one"), 0)

    def test_header_that_does_not_exist(self):
        self.include("haptics/sliding/one.cpp", '"sliding/none.h"')
        self.expect("haptics/sliding/one.cpp", "sliding/none.h does not exist")

    def test_one_public_header_too_many(self):
        installed = [path.parent for path in self.root.glob("*/CMakeLists.txt")
                     if "glissade_add_component(" in path.read_text() and "NOT_INSTALLED" not in path.read_text()]
        count = sum(len(list(folder.glob("*.h"))) for folder in installed)
        for number in range(count, LIMIT):
            self.write(f"realtime/header_{number}.h", "")
            self.list_header("realtime", f"header_{number}.h")
        self.assertNotIn(f"more than {LIMIT}", run_check(self.root).stdout)
        self.write("realtime/one.h", "")
        self.list_header("realtime", "one.h")
        self.expect("CMakeLists.txt", f"{LIMIT + 1} public headers")

    def test_header_that_is_not_listed(self):
        self.write("realtime/one.h", "")
        self.expect("realtime/one.h", "not among HEADERS")

    def test_room_header_that_is_listed(self):
        self.write("realtime/room/one.h", "")
        self.list_header("realtime", "room/one.h")
        self.expect("realtime/CMakeLists.txt", "room/one.h")

    def test_haptic_thread_that_reaches_recordings(self):
        self.write("haptics/record/one.h", "")
        self.write("haptics/loop/one.h", "")
        self.include("haptics/loop/contact_force.h", '"loop/one.h"')
        self.include("haptics/loop/one.cpp", '"record/one.h"')
        self.expect("haptics/loop/one.cpp", "haptic thread", "haptics/loop/one.cpp -> haptics/record/one.h")

    def test_contact_force_that_includes_the_certificate(self):
        self.write("haptics/certificate/one.h", "")
        self.include("haptics/loop/contact_force.h", '"certificate/one.h"')
        self.expect("haptics/loop/contact_force.h", "haptics/loop/contact_force.h -> haptics/certificate/one.h")

    def test_contact_force_that_reaches_collision(self):
        self.include("haptics/loop/contact_force.h", "<glissade/collision/dop_tree.h>")
        self.expect("haptics/loop/contact_force.h", "contact force must not reach collision/")

    def test_engine_that_reaches_devices(self):
        self.include("contact/sliding.h", "<glissade/devices/glove_device.h>")
        self.expect("contact/sliding.h", "engine must not reach devices", "contact/sliding.h -> devices/glove_device.h")

    def test_file_that_is_too_long(self):
        self.write("contact/one.cpp", "\n" * 401)
        self.expect("contact/one.cpp", "401 lines")

    def test_function_that_is_too_long(self):
        body = "".join(f"  if (n == {i}) return {i};\n" for i in range(59))
        self.write("contact/one.cpp", f"namespace a {{\n\nint f(int n) {{\n{body}}}\n\nint g(int n) {{\n{body}  return 0;\n}}\n\n}}\n")
        self.expect("contact/one.cpp", "62 lines")
        self.write("contact/two.cpp", f"namespace a {{\n\nOne::One(int n)\n    : a_{{1}}, b_(n) {{\n{body}}}\n\n}}\n")
        self.expect("contact/two.cpp", "62 lines")

    def test_type_without_a_row(self):
        path = self.root / "contact/sliding.h"
        self.write("contact/sliding.h", path.read_text() + "struct Unheard {\n};\n")
        self.expect("docs/types.md", "no row for Unheard")
        self.expect("contact/CMakeLists.txt", "36 types")

    def test_folder_of_tests_without_a_component(self):
        self.write("tests/nothing/one_test.cpp", "")
        self.write("bench/apps/one.cpp", "")
        self.expect("tests/nothing", "not named after a component")
        self.expect("bench/apps", "not named after a component")


if __name__ == "__main__":
    unittest.main()

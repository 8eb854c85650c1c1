"""The rows of results.csv, by bench, case, subject and metric."""

import csv
import math
import re
import typing

PEERS = ["fcl", "ode", "bullet", "cgal"]
HULL_PEERS = ["libccd", "libccd-mpr", "fcl", "bullet"]
PART_PEERS = ["fcl", "pqp"]
PEER_TITLES = {"fcl": "FCL", "ode": "ODE", "bullet": "Bullet", "cgal": "CGAL", "pqp": "PQP's method", "libccd": "libccd GJK", "libccd-mpr": "libccd MPR"}


def geometric_mean(values):
    return math.exp(sum(math.log(value) for value in values) / len(values))


class Figures:
    """The rows of one bench. A figure that was not measured is None; hashes stay text."""

    def __init__(self, rows):
        self.values = {}
        self.cases = []
        self.subjects = []
        for row in rows:
            key = (row["case"], row["subject"], row["metric"])
            self.values[key] = row["value"] if row["unit"] == "hex" else float(row["value"])
            if row["case"] not in self.cases:
                self.cases.append(row["case"])
            if row["subject"] not in self.subjects:
                self.subjects.append(row["subject"])

    def get(self, case, subject, metric):
        return self.values.get((case, subject, metric))

    def measured_cases(self):
        """Cases that compare Glissade with others."""
        return [case for case in self.cases if self.get(case, "fcl", "time") is not None]

    def variants(self):
        return [subject for subject in self.subjects if subject.startswith("glissade")]

    def count_disagreements(self, subject):
        """Number of answers that differ from Glissade's, over all cases; None if no answers were compared."""
        found = [value for (_, who, metric), value in self.values.items() if who == subject and metric == "disagreements"]
        return sum(found) if found else None


def read_results(path):
    """Figures by bench."""
    rows = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            rows.setdefault(row["bench"], []).append(row)
    return {bench: Figures(bench_rows) for bench, bench_rows in rows.items()}


def split_case(case):
    """"sphere-20k" is the shape "sphere" with 20000 triangles; a user's mesh has no number."""
    match = re.fullmatch(r"(.+)-(\d+)(k|M|)", case)
    if not match:
        return case, None
    return match[1], int(match[2]) * {"k": 1000, "M": 1000000, "": 1}[match[3]]


def shapes(figures):
    """The shapes measured at two sizes or more, in order, each with its (triangles, case)."""
    found = {}
    for case in figures.cases:
        shape, triangles = split_case(case)
        if triangles and figures.get(case, "glissade", "time") is not None:
            found.setdefault(shape, []).append((triangles, case))
    return {shape: sorted(sizes) for shape, sizes in found.items() if len(sizes) > 1}


class HullCase(typing.NamedTuple):
    """The fields of a case such as "sphere-1000-0.05deg-gap-1e-4": corners of each hull, degrees a step, "gap-1e-4" or "depth-1e-3"."""
    shape: str
    corners: int
    degrees: float
    gap: str


def hull_times(figures):
    """Mean time of a query in µs, by case and then by subject."""
    times = {}
    for (name, subject, metric), ns in figures.values.items():
        match = re.fullmatch(r"(\w+)-(\d+)-([\d.]+)deg-((?:gap|depth)-.+)", name)
        if match and metric == "time":
            case = HullCase(match[1], int(match[2]), float(match[3]), match[4])
            times.setdefault(case, {})[subject] = ns / 1000
    return times

"""What a change affects, on a workspace made up here and on this one."""

import unittest

from affected import ROOT, READERS, CHECKS, checks, packages, workspace

CRATES = {
    "core": ("crates/base/core/", set(), set()),
    "io": ("crates/show/io/", {"core"}, set()),
    "engine": ("crates/systems/engine/", {"core"}, {"io"}),
    "ranking": ("crates/systems/ranking/", {"engine"}, set()),
    "cli": ("crates/doors/cli/", {"io", "ranking"}, set()),
}


class Affected(unittest.TestCase):
    def test_dependents_are_affected(self):
        self.assertEqual(packages(["crates/base/core/src/lib.rs"], CRATES), sorted(CRATES))
        self.assertEqual(packages(["crates/systems/ranking/Cargo.toml"], CRATES), ["cli", "ranking"])

    def test_a_dependency_of_tests_affects_no_library(self):
        self.assertEqual(packages(["crates/show/io/src/lib.rs"], CRATES), ["cli", "engine", "io"])

    def test_changed_tests_affect_no_other_crate(self):
        self.assertEqual(packages(["crates/base/core/tests/evidence/main.rs"], CRATES), ["core"])

    def test_the_build_affects_all(self):
        self.assertEqual(packages(["Cargo.lock"], CRATES), sorted(CRATES))
        self.assertEqual(checks(["Cargo.lock"]), ["licences"])

    def test_documents_affect_no_crate(self):
        self.assertEqual((packages(["CHANGELOG.md"], CRATES), checks(["CHANGELOG.md"])), ([], []))

    def test_checks_by_path(self):
        self.assertEqual(checks(["python/pompeiu/ray.py"]), ["cluster", "python"])
        self.assertEqual(checks(["crates/show/figures/web/src/main.js", "docs/guide/pages/index.md"]), ["browser", "guide"])
        self.assertEqual(checks(["crates/systems/fields/src/show/page.rs"]), ["browser"], "pages of any system")

    def test_this_workspace(self):
        crates = workspace()
        everything = packages(["crates/base/core/src/lib.rs"], crates)
        self.assertLessEqual({"pompeiu-core", "pompeiu-io", "pompeiu-cli", "pompeiu-py"}, set(everything))
        self.assertLessEqual(set(READERS.values()), set(crates))

    def test_paths_exist(self):
        for start in [*CHECKS, *READERS]:
            folder, name = (start, "") if start.endswith("/") else start.rpartition("/")[::2]
            self.assertTrue(any((ROOT / folder).glob(name + "*")), start)


if __name__ == "__main__":
    unittest.main()

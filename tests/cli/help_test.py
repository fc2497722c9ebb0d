import os
import unittest

from program import ProgramTest


class Help(ProgramTest):
    def test_version_is_the_projects(self):
        self.assertEqual(self.succeed("--version"), f"geovor {os.environ['GEOVOR_VERSION']}\n")

    def test_help_names_every_command(self):
        text = self.succeed("--help")
        for command in ("info", "mesh", "voronoi", "distance", "check"):
            self.assertIn(f"\n  {command} ", text)

    def test_help_tells_the_exit_codes(self):
        self.assertIn("3 some face was not finished", self.succeed("--help"))

    def test_help_of_mesh_names_its_options(self):
        text = self.succeed("mesh", "--help")
        for option in ("--size", "--min-size", "--deflection", "--angle", "--gradation", "--faces", "--threads", "--report",
                       "--progress", "--no-progress", "--ascii", "--strict", "-o"):
            self.assertIn(option, text)

    def test_help_of_voronoi_names_its_options(self):
        text = self.succeed("voronoi", "--help")
        for option in ("--face", "--sites", "--count", "--seed", "-o"):
            self.assertIn(option, text)

    def test_help_of_distance_names_its_options(self):
        text = self.succeed("distance", "--help")
        for option in ("--face", "--from", "--to", "--snap", "-o"):
            self.assertIn(option, text)

    def test_help_of_info_names_its_options(self):
        self.assertIn("--json", self.succeed("info", "--help"))


if __name__ == "__main__":
    unittest.main()

"""Output files are complete or absent."""

import signal
import stat
import subprocess
import unittest

from program import INTERRUPTED, PROGRAM, ProgramTest, sample


class Outputs(ProgramTest):
    def test_nothing_but_the_outputs_is_left(self):
        self.succeed("mesh", sample("cylinder.step"), "--size", 4, "-o", "a.stl", "-o", "a.step", "-o", "b.obj", "-o",
                     "c.svg", "--report", "r.json")
        self.assertEqual(self.files(), ["a.step", "a.stl", "b.obj", "c.svg", "r.json"])

    def test_outputs_may_be_read_by_whom_the_umask_allows(self):
        self.succeed("mesh", sample("cylinder.step"), "--size", 4, "-o", "a.stl", "-o", "a.step", "--report", "r.json")
        self.write("witness", "")
        expected = stat.S_IMODE((self.folder / "witness").stat().st_mode)
        for name in ("a.stl", "a.step", "r.json"):
            self.assertEqual(stat.S_IMODE((self.folder / name).stat().st_mode), expected, name)

    def test_an_older_output_is_replaced(self):
        self.write("a.stl", "old")
        self.succeed("mesh", sample("cylinder.step"), "--size", 4, "-o", "a.stl")
        self.assertGreater((self.folder / "a.stl").stat().st_size, 84)

    def test_an_older_output_survives_a_failure(self):
        self.write("a.stl", "old")
        self.run_program("mesh", "missing.step", "--size", 4, "-o", "a.stl")
        self.assertEqual((self.folder / "a.stl").read_text(), "old")

    def test_the_ending_may_be_in_capitals(self):
        self.succeed("mesh", sample("cylinder.step"), "--size", 4, "-o", "A.STL")
        self.assertEqual((self.folder / "A.STL").stat().st_size % 50, 84 % 50)

    def test_a_link_is_followed(self):
        (self.folder / "real").mkdir()
        (self.folder / "link.stl").symlink_to("real/part.stl")
        self.succeed("mesh", sample("cylinder.step"), "--size", 4, "-o", "link.stl")
        self.assertTrue((self.folder / "link.stl").is_symlink())
        self.assertGreater((self.folder / "real" / "part.stl").stat().st_size, 84)
        self.assertEqual(self.files(), ["link.stl", "real", "real/part.stl"])

    def test_an_interrupt_stops_soon_and_leaves_nothing(self):
        program = subprocess.Popen([PROGRAM, "mesh", sample("plate.step"), "--size", "0.3", "-o", "out.stl", "--progress"],
                                   cwd=self.folder, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.assertIn("faces meshed 1/15", program.stderr.readline())
        program.send_signal(signal.SIGINT)
        program.communicate(timeout=10)
        self.assertEqual(program.returncode, INTERRUPTED)
        self.assertEqual(self.files(), [])

    def test_a_full_disk_is_told(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([PROGRAM, "info", sample("cylinder.step")], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (4, 1))


if __name__ == "__main__":
    unittest.main()

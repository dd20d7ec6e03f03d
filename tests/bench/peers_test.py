"""What `./run bench peers` does without its peers: the figures of noise have the values that theory
says, the report marks what does not agree, Onde reads the scenes that are described for it.

Run by ctest: peers_test.py ONDE. Exits 77 where there is no numpy.
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("there is no numpy for this Python")
    sys.exit(77)

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench/peers"))
import onde
import report
import scene as scenes_folder
import scenes
import shapes
import statistics_of_noise as figures

ONDE = sys.argv.pop(1)
FIGURES = {"samples_per_second": 2e6, "error": 0.02, "trimmed": 0.01, "samples": 64, "mean": 0.5, "mean_deviation": 0.001,
           "first_seconds": 2.0, "later_seconds": 1.0, "peak_mib": 100.0}


def noisy(random, deviation, count):
    return [1 + deviation * random.standard_normal((64, 64, 3)) for _ in range(count)]


class Statistics(unittest.TestCase):
    def test_noise_of_pictures_is_their_variance_whatever_the_noise_of_their_reference(self):
        random = np.random.default_rng(1)
        for references in 2, 16:
            error, trimmed = figures.noise(noisy(random, 0.2, 4), noisy(random, 0.2, references))
            expected = 0.2**2 / 1.01
            # Of 4 x 64 x 64 x 3 squares: a standard deviation of 0.6 %; that of the reference adds 0.3 %.
            self.assertAlmostEqual(error / expected, 1, delta=0.03)
            self.assertLess(trimmed, error)

    def test_one_firefly_counts_in_all_pixels_but_not_in_the_trimmed_ones(self):
        random = np.random.default_rng(2)
        picture = noisy(random, 0.1, 1)[0]
        bright = picture.copy()
        bright[3, 5] = 1000
        references = noisy(random, 0.1, 4)
        self.assertGreater(figures.noise([bright], references)[0], 10 * figures.noise([picture], references)[0])
        self.assertAlmostEqual(figures.noise([bright], references)[1], figures.noise([picture], references)[1], delta=1e-4)

    def test_error_of_a_mean_comes_from_the_differences_of_its_pictures(self):
        mean, deviation = figures.mean_with_error([np.full((2, 2, 3), value) for value in (0.9, 1.0, 1.1)])
        self.assertAlmostEqual(mean, 1.0)
        self.assertAlmostEqual(deviation, 0.1 / 3**0.5)

    def test_half_the_time_and_a_third_of_the_noise_need_a_sixth_for_equal_error(self):
        ours = FIGURES | {"samples_per_second": 4e6, "trimmed": 0.01 / 3, "mean": 0.505}
        ratio = figures.ratios(ours, FIGURES)
        self.assertAlmostEqual(ratio["equal_error"], 1 / 6)
        self.assertTrue(ratio["agrees"])
        self.assertFalse(figures.ratios(ours | {"mean": 0.52}, FIGURES)["agrees"])

    def test_samples_beyond_what_was_asked_for_count_in_the_noise_of_one(self):
        self.assertAlmostEqual(figures.ratios(FIGURES | {"samples": 128}, FIGURES)["noise"], 2)


class Report(unittest.TestCase):
    def test_doubtful_and_failed_peers_are_told_of(self):
        results = {"onde": FIGURES, "near": FIGURES, "far": FIGURES | {"mean": 0.6}, "broken": {"failed": "no memory"}}
        text = report.scene_text("hall", results)
        self.assertIn("can't: no memory", text)
        self.assertIn("of far differ by more than 2 %", text)
        rows = {line.split(" | ")[0].strip("| "): line for line in text.split("Onde over")[1].splitlines()}
        self.assertIn("(?)", rows["far"])
        self.assertNotIn("(?)", rows["near"])
        self.assertNotIn("broken", rows)

    def test_without_onde_there_are_no_ratios(self):
        text = report.scene_text("hall", {"onde": {"failed": "no device"}, "near": FIGURES})
        self.assertNotIn("Onde over", text)


class Scenes(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())

    def test_scenes_survive_their_folder(self):
        scene = scenes.fog(self.folder)
        scene.save(self.folder)
        loaded = scenes_folder.load(self.folder)
        self.assertTrue(loaded.has_media)
        self.assertEqual(json.dumps(scene.camera.position), json.dumps(loaded.camera.position))
        for mesh, again in zip(scene.meshes, loaded.meshes, strict=True):
            np.testing.assert_array_equal(mesh.positions, again.positions)
            np.testing.assert_array_equal(mesh.triangles, again.triangles)

    def test_fronts_of_closed_meshes_look_outward(self):
        for mesh in shapes.box("", (1, 2, 3), (2, 4, 6)), shapes.sphere("", (5, 0, 0), 2):
            corners = mesh.positions[mesh.triangles] - mesh.positions.mean(0)
            volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
            self.assertGreater(volume.min(), 0)
        self.assertAlmostEqual(volume.sum() / (4 / 3 * np.pi * 8), 1, delta=2e-3)

    def test_hills_have_a_million_triangles(self):
        hills = shapes.terrain("", 12, 708, lambda x, z: 0 * x)
        self.assertGreater(len(hills.triangles), 1_000_000)
        self.assertEqual(hills.triangles.max() + 1, len(hills.positions))

    def test_onde_reads_the_scenes_without_a_note(self):
        for make in scenes.cornell, scenes.lamps, scenes.fog:
            scene = make(self.folder)
            onde.prepare(scene, self.folder)
            said = subprocess.run([ONDE, "info", self.folder / "onde.toml", "--json"], capture_output=True, text=True)
            self.assertEqual(said.returncode, 0, said.stderr)
            info = json.loads(said.stdout)
            self.assertEqual(info["notes"], [])
            self.assertEqual(info["unique_triangles"], sum(len(mesh.triangles) for mesh in scene.meshes))


if __name__ == "__main__":
    unittest.main()

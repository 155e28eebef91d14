"""The slips of exercise 10: each changes our kernel in one place, and in `make soak` each is told from ours and from
the others by the numbers of its test."""
import sys
import tempfile
import unittest
from pathlib import Path

from support.program import SOAK

sys.path.insert(0, str(Path(__file__).resolve().parent / "exercises" / "10"))
import check  # noqa: E402
import slips  # noqa: E402
import words  # noqa: E402


class List(unittest.TestCase):
    def test_each_is_of_a_test_that_is_there(self):
        self.assertGreater(len(slips.SLIPS), 30)
        for test, text, meaning in slips.SLIPS:
            with self.subTest(meaning):
                self.assertIn(test, words.TITLES)
                self.assertNotEqual(text, slips.OURS)

    def test_each_has_words_of_its_own(self):
        meanings = [(test, meaning) for test, _, meaning in slips.SLIPS]
        self.assertEqual(len(set(meanings)), len(meanings))
        self.assertEqual(set(words.VALUES), set(words.CASES))


@unittest.skipUnless(SOAK, "compiles some twenty kernels: `make soak`")
class Slips(unittest.TestCase):
    def numbers_of(self, test, text):
        with tempfile.TemporaryDirectory() as folder:
            found = check.numbers_of([test], Path(folder) / "kernels", text)
        return found[test, ""], found[test, "our_"]

    def test_each_gives_numbers_of_its_own(self):
        for test in words.CASES:
            seen = []
            for name, text, meaning in slips.SLIPS:
                if name != test:
                    continue
                with self.subTest(meaning):
                    slipped, ours = self.numbers_of(test, text)
                    self.assertFalse(check.equal(slipped, ours), "no case shows it")
                    for other, said in seen:
                        self.assertFalse(check.equal(slipped, other), f"the same as: {said}")
                    seen.append((slipped, meaning))


if __name__ == "__main__":
    unittest.main(verbosity=2)

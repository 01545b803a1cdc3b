"""What the tests of pairsum_results share: the package's path, and the committed rows."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "plots"), str(ROOT / "tests"), str(pathlib.Path(__file__).resolve().parent)]

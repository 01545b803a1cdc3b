"""What of results/ is in git; runs add more to it."""
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]


def committed(pattern: str, root: pathlib.Path = ROOT) -> list[pathlib.Path]:
    """The files of this pattern that git lists; all that are there, where git does not know the tree."""
    names = ""
    if shutil.which("git"):
        command = ["git", "-c", f"safe.directory={root}", "-C", root, "ls-files", "-z", f":(glob){pattern}"]
        names = subprocess.run(command, capture_output=True, text=True).stdout
    return sorted(root / name for name in names.split("\0") if name) or sorted(root.glob(pattern))

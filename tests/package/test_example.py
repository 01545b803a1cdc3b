"""The example, built against what was installed, finds every backend right and a wrong interaction out."""

import shutil

import pytest

from conftest import SOURCE, call, must


@pytest.fixture
def example(tmp_path):
    """A copy, so that nothing beside it is found by chance."""
    return shutil.copytree(SOURCE / "examples/sph_density", tmp_path / "sph_density")


def run(project, folder):
    build, configured = project(folder)
    assert configured.returncode == 0, configured.stdout
    must("cmake", "--build", build)
    return call(build / "sph_density")


def test_every_backend_agrees(project, example, built):
    done = run(project, example)
    assert done.returncode == 0, done.stdout
    lines = {line.split()[0]: line.split() for line in done.stdout.splitlines()[1:]}
    assert list(lines) == built("BACKENDS")
    for _, share, rho in lines.values():
        assert 0 <= float(share) <= 1
        assert float(rho) == pytest.approx(1000, rel=0.01)


def test_an_interaction_that_lies_is_found_out(project, example, built):
    """Its two sides do not match: a backend that uses both disagrees with the reference, which uses one."""
    main = example / "main.cpp"
    lie = main.read_text().replace("m_i * w}", "1.001 * m_i * w}")
    assert lie.count("1.001") == 1
    main.write_text(lie)
    done = run(project, example)
    assert done.returncode == 1, done.stdout
    wrong = {line.split()[0]: "WRONG" in line for line in done.stdout.splitlines()[1:]}
    assert wrong == {name: not name.startswith("naive") for name in built("BACKENDS")}

"""harness/scripts/dependencies.sh with stubs of dpkg-query, apt-get, sudo and id."""
import pytest

DPKG_QUERY = """#!/bin/bash
for name in ${STUB_INSTALLED-}; do echo "installed $name"; done
echo "config-files cmake"
exit 1
"""
APT_GET = """#!/bin/bash
echo "apt-get $* as ${STUB_ROOT-nobody} $DEBIAN_FRONTEND" >>"$LOG"
[[ "$*" != *install* ]] || exit "${STUB_APT_STATUS:-0}"
"""
SUDO = """#!/bin/bash
[[ -n ${STUB_SUDO-} && $1 == -n ]] || exit 1
shift
STUB_ROOT=sudo exec "$@"
"""
LINE = "apt-get install -y --no-install-recommends "
ALL_PLOTS = "python3-pandas python3-scipy python3-matplotlib python3-jinja2"


@pytest.fixture
def debian(sandbox):
    sandbox.stub("dpkg-query", DPKG_QUERY)
    sandbox.stub("apt-get", APT_GET)
    sandbox.stub("sudo", SUDO)
    sandbox.stub("id", "#!/bin/bash\necho ${STUB_ID:-1000}\n")
    return sandbox


def ensure(sandbox, groups="build plots", **variables):
    return sandbox.run("bash", "-euo", "pipefail", "-c",
                       f"source harness/scripts/dependencies.sh; ensure_packages {groups}",
                       **variables)


def packages(sandbox, groups):
    return sandbox.run("bash", "-c", "source harness/scripts/dependencies.sh; "
                       f"packages_of {groups}").stdout.split()


def test_the_groups_have_no_package_twice(sandbox):
    every = packages(sandbox, "build plots tests")
    assert len(every) == len(set(every))
    assert {"g++", "python3-scipy", "python3-jinja2", "clang-14", "chromium"} <= set(every)


def test_nothing_is_done_if_all_are_installed(debian):
    done = ensure(debian, STUB_INSTALLED=" ".join(packages(debian, "build plots")))
    assert (done.returncode, done.stderr) == (0, "")
    assert debian.calls() == []


def test_root_installs_what_is_missing(debian):
    installed = [name for name in packages(debian, "build plots")
                 if name not in ("cmake", "g++", "libtbb-dev")]
    done = ensure(debian, STUB_ID="0", STUB_ROOT="root", STUB_INSTALLED=" ".join(installed))
    assert done.returncode == 0
    update, install = debian.calls("apt-get")
    assert " update as root noninteractive" in update
    assert "install -y --no-install-recommends g++ cmake libtbb-dev as root noninter" in install


def test_a_user_who_may_sudo_installs_too(debian):
    done = ensure(debian, "plots", STUB_SUDO="1",
                  STUB_INSTALLED="python3-pandas python3-scipy python3-jinja2")
    assert done.returncode == 0
    assert "--no-install-recommends python3-matplotlib as sudo nonint" in debian.calls()[-1]


def test_another_user_is_told_the_line(debian):
    done = ensure(debian, "plots",
                  STUB_INSTALLED="python3-pandas python3-scipy python3-matplotlib-data python3-jinja2")
    assert done.returncode == 3
    assert done.stderr.splitlines()[-1].strip() == LINE + "python3-matplotlib"
    assert debian.calls() == []


def test_a_failing_installation_tells_the_line(debian):
    done = ensure(debian, "plots", STUB_ID="0", STUB_APT_STATUS="100")
    assert done.returncode == 3
    assert done.stderr.splitlines()[-1].strip() == LINE + ALL_PLOTS


def test_another_system_is_told_the_list(sandbox):
    sandbox.links("bash", "cat", "grep", "env", "id")
    done = ensure(sandbox, "plots")
    assert done.returncode == 3
    assert "no Debian" in done.stderr
    assert done.stderr.splitlines()[-1].strip() == ALL_PLOTS


@pytest.mark.parametrize("script", ["./run_all.sh", "./run_tests.sh"])
def test_a_script_stops_before_it_builds(debian, script):
    done = debian.run(script)
    assert done.returncode == 3
    assert LINE + "g++ cmake" in done.stderr
    assert debian.calls() == []


@pytest.mark.parametrize("script", ["./run_all.sh", "./run_tests.sh"])
def test_no_install_looks_for_no_package(debian, script):
    done = debian.run(script, "--no-install", STUB_CMAKE_STATUS="7")
    assert done.returncode == 7, done.stderr
    assert "configuring the build failed (exit 7)" in done.stderr
    assert debian.calls("apt-get") == []


def test_a_python_without_the_modules_stops(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", PYTHON="/bin/false")
    assert done.returncode == 3
    assert done.stderr.splitlines()[-1].strip() == LINE + ALL_PLOTS
    assert sandbox.calls() == []

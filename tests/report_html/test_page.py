"""The page in a browser, wide and narrow, light and dark, printed."""
import pytest
from selenium.webdriver.common.by import By

import browser
import figures
import made_summary
import page_check
import strategy_tables
from conftest import other_machine

WIDTHS = (1280, 390)


@pytest.fixture(params=["one", "compared"])
def either(request, page, compared):
    """The page of one machine, and that of two."""
    return {"one": page, "compared": compared}[request.param]


@pytest.mark.parametrize("width", WIDTHS)
def test_the_page_is_quiet_loads_nothing_and_fits(chromium, either, width):
    browser.show(chromium, either, width)
    assert browser.console(chromium) == []
    assert browser.requests(chromium, either) == []
    wide, inner = chromium.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
    assert inner == width and wide <= width


def test_the_file_refers_to_nothing_outside_and_is_small(page, compared):
    for path in (page, compared):
        assert page_check.external(path.read_text()) == []
        assert path.stat().st_size < 3e6


_FIGURES = """return [...document.querySelectorAll("svg.figure")].map((svg) => {
  const box = svg.getBoundingClientRect(), room = svg.parentElement;
  return [box.width, box.height, svg.querySelectorAll("text").length, svg.getAttribute("aria-label"),
          room.clientWidth, getComputedStyle(room).overflowX, svg.parentElement.parentElement.tagName]; })"""


@pytest.mark.parametrize("width", WIDTHS)
def test_every_figure_is_there_and_can_be_read(chromium, page, width):
    browser.show(chromium, page, width)
    headings = [head.text for head in chromium.find_elements(By.CSS_SELECTOR, "#figures h3")]
    assert headings == [heading for heading, _ in figures.FIGURES.values()]
    drawn = chromium.execute_script(_FIGURES)
    assert len(drawn) >= len(figures.FIGURES)
    for wide, high, texts, label, room, overflow, around in drawn:
        assert wide > 250 and high > 80 and texts > 5 and len(label) > 40
        assert wide <= room + 1 or overflow == "auto"
        assert around == "FIGURE"


def test_strategies_have_a_section_with_figures_and_tables(chromium, page):
    browser.show(chromium, page)
    headings = [head.text for head in chromium.find_elements(By.CSS_SELECTOR, "#strategies h3")]
    assert headings == [heading for heading, _ in figures.STRATEGIES.values()] + [
        heading for _, heading, *_ in strategy_tables.TABLES]
    said = chromium.find_element(By.ID, "strategies").text
    made = made_summary.full(ms=(6, 7))
    for row in made["strategies"]:
        assert row["backend"] in said and row["aliases"] in said
    first = chromium.execute_script("return document.querySelector('#table-strategies ~ .machines tbody tr').innerText")
    assert "what the field calls" in first and "not in what was measured" in first


def test_without_strategies_there_is_no_section(chromium, program, two):
    two.update(strategies=[], strategy_ladder=[], strategy_threads=[], strategy_shifts=[])
    _, path = program(two)
    browser.show(chromium, path)
    assert not chromium.find_elements(By.ID, "strategies") and browser.console(chromium) == []
    assert "Strategies" not in chromium.find_element(By.ID, "contents").text


def test_machines_stand_beside_each_other_and_below_each_other_on_a_phone(chromium, compared):
    places = ("return [...document.querySelectorAll('#figure-speedup ~ .machines')[0].children]"
              ".map((one) => [one.getBoundingClientRect().left, one.querySelectorAll('svg').length])")
    browser.show(chromium, compared, 1280)
    (first, some), (second, others) = chromium.execute_script(places)
    assert second > first + 300 and some == others == 1
    browser.show(chromium, compared, 390)
    (first, _), (second, _) = chromium.execute_script(places)
    assert second == first
    assert "bignode" in chromium.find_element(By.ID, "environments").text


def test_the_answer_stands_first(chromium, page, compared):
    for path, made in ((page, made_summary.full(ms=(6, 7))), (compared, other_machine())):
        browser.show(chromium, path)
        first = chromium.execute_script("return document.body.innerText.trim()")
        answer = made["answer"] if path is page else made_summary.make(states=("rest",), ms=(6, 7))["answer"]
        assert first.startswith(answer["text"])
        said = chromium.find_element(By.ID, "answer").text
        assert f"{made['answer']['speedup']:.3g}"[:4] in said and "interval" in said
        assert f"The base, naive, M={made['answer']['base_M']}, 1 thread, takes " in said
    order = chromium.execute_script("return [...document.querySelectorAll('h2')].map((head) => head.innerText)")
    assert order == ["Questions", "Figures", "Strategies", "Tables", "Environments", "Caveats"]


@pytest.mark.parametrize("width", WIDTHS)
def test_the_contents_lead_everywhere(chromium, page, width):
    browser.show(chromium, page, width)
    contents = chromium.find_element(By.CSS_SELECTOR, "#contents details")
    assert (contents.get_attribute("open") is not None) == (width > 1000)
    if width < 1000:
        contents.find_element(By.TAG_NAME, "summary").click()
    links = contents.find_elements(By.TAG_NAME, "a")
    assert len(links) > 15 and all(link.is_displayed() for link in links)
    assert chromium.execute_script("return [...document.querySelectorAll('#contents a')]"
                                   ".every((link) => document.querySelector(link.getAttribute('href')))")
    links[-1].click()
    assert chromium.execute_script("return location.hash") == "#caveats"
    top = chromium.execute_script("return document.querySelector('#head-caveats').getBoundingClientRect().top")
    assert 0 <= top < 900
    assert (contents.get_attribute("open") is not None) == (width > 1000)


_TEXTS = "h1, h2, h3, p, figcaption, td, th button, dt, dd, li, a, svg.figure text"


@pytest.mark.parametrize("width", WIDTHS)
def test_light_and_dark_both_can_be_read(chromium, page, width):
    seen = {}
    for scheme in ("light", "dark"):
        browser.show(chromium, page, width, scheme)
        seen[scheme] = browser.contrasts(chromium, _TEXTS)
        assert [item for item in seen[scheme] if item[3] < 4.5] == []
    for light, dark in zip(seen["light"], seen["dark"]):
        assert light[0] == dark[0] and light[1] != dark[1] and light[2] != dark[2]


def test_low_contrast_is_found(chromium, tmp_path):
    path = tmp_path / "pale.html"
    path.write_text('<p style="color:#999;background:#fff">pale</p>')
    browser.show(chromium, path)
    (_, _, _, contrast), = browser.contrasts(chromium, "p")
    assert 2.8 < contrast < 2.9


def test_print_is_light_whole_and_without_contents(chromium, page):
    browser.show(chromium, page, 720, "dark", media="print")
    assert not chromium.find_element(By.ID, "contents").is_displayed()
    assert chromium.execute_script("return matchMedia('print').matches")
    assert browser.contrasts(chromium, "h1")[0][1:3] == ("29,33,37,255", "255,255,255,255")
    for wide, high, _, _, room, overflow, _ in chromium.execute_script(_FIGURES):
        assert overflow == "visible" and wide <= room + 1 and high < 23 / 2.54 * 96 + 1
    assert chromium.execute_script("return [...document.querySelectorAll('.table')].every("
                                   "(table) => table.scrollHeight <= table.clientHeight + 1)")

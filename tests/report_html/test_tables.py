"""Tables sort by every kind of column, with mouse and keyboard."""
import re

import pytest
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

import browser

_COLUMN = "return [...arguments[0].tBodies[0].rows].map((row) => row.cells[arguments[1]].textContent)"


def heads(table):
    return table.find_elements(By.CSS_SELECTOR, "thead th")


def press(driver, head):
    driver.execute_script("arguments[0].scrollIntoView({block: 'center', inline: 'center'})", head)
    head.find_element(By.TAG_NAME, "button").click()
    return head.get_attribute("aria-sort")


def numbers(texts):
    """Return the first number of each text (an interval sorts by its low end), empty ones as None."""
    return [float(text.split()[0]) if text else None for text in texts]


def natural(text):
    """Return a key that puts "slowed 5 %" before "slowed 20 %"."""
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", text.lower())]


def is_sorted(values, up):
    known = [value for value in values if value is not None]
    return values == sorted(known, reverse=not up) + [None] * (len(values) - len(known))


@pytest.mark.parametrize("width", [1280, 390])
def test_each_table_sorts_by_number_and_by_text(chromium, page, width):
    browser.show(chromium, page, width)
    tables = chromium.find_elements(By.TAG_NAME, "table")
    assert len(tables) >= 7
    for table in tables:
        before = chromium.execute_script(_COLUMN, table, 0)
        number = next((at for at, head in enumerate(heads(table)) if "number" in head.get_attribute("class")
                       and len(set(chromium.execute_script(_COLUMN, table, at))) > 1), None)
        some = (("ascending", True), ("descending", False), ("ascending", True))
        for state, up in some if number is not None else ():  # one of words alone has none
            assert press(chromium, heads(table)[number]) == state
            assert is_sorted(numbers(chromium.execute_script(_COLUMN, table, number)), up)
        word = next(at for at, head in enumerate(heads(table)) if "number" not in head.get_attribute("class"))
        for state, up in (("ascending", True), ("descending", False)):
            assert press(chromium, heads(table)[word]) == state
            texts = chromium.execute_script(_COLUMN, table, word)
            assert texts == sorted(texts, key=natural, reverse=not up)
        assert [head.get_attribute("aria-sort") for head in heads(table)].count("none") == len(heads(table)) - 1
        assert sorted(chromium.execute_script(_COLUMN, table, 0)) == sorted(before)
    assert browser.console(chromium) == []


def test_the_keyboard_sorts(chromium, page):
    browser.show(chromium, page)
    table = chromium.find_element(By.CSS_SELECTOR, "#table-points ~ .machines table")
    at = [head.text.strip() for head in heads(table)].index("sum [ms]")
    button = heads(table)[at].find_element(By.TAG_NAME, "button")
    for key, up in ((Keys.ENTER, True), (Keys.SPACE, False)):
        button.send_keys(key)
        assert is_sorted(numbers(chromium.execute_script(_COLUMN, table, at)), up)


def test_a_wrong_order_is_found():
    assert is_sorted([1.0, 2.0, None], True) and is_sorted([2.0, 1.0, None], False)
    assert not is_sorted([1.0, None, 2.0], True) and not is_sorted([10.0, 9.0], True)


def test_rows_stay_together(chromium, page):
    browser.show(chromium, page)
    table = chromium.find_element(By.CSS_SELECTOR, "#table-points ~ .machines table")
    rows = "return [...arguments[0].tBodies[0].rows].map((row) => row.textContent).sort()"
    before = chromium.execute_script(rows, table)
    press(chromium, heads(table)[3])
    assert chromium.execute_script(rows, table) == before

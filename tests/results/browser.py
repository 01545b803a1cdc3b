"""A headless Chromium and what a test asks it."""
import json
import os

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service


def start():
    """Return a driver of Debian's Chromium that logs the console and the network."""
    options = Options()
    for word in ("--headless=new", "--disable-gpu", "--hide-scrollbars", "--disable-dev-shm-usage",
                 "--no-first-run", "--disable-background-networking"):
        options.add_argument(word)
    if os.geteuid() == 0:
        options.add_argument("--no-sandbox")  # Chromium refuses to run as root with it
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))


def show(driver, path, width=1280, scheme="light", media=""):
    """Load a page afresh at a width, in a colour scheme, for screen or print."""
    driver.get("about:blank")
    for log in ("browser", "performance"):
        driver.get_log(log)
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 500})
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
        "media": media, "features": [{"name": "prefers-color-scheme", "value": scheme}]})
    driver.get(f"file://{path}")


def open_all(driver):
    """Unfold everything."""
    driver.execute_script("for (const one of document.querySelectorAll('main details')) one.open = true")


def show_all(driver):
    """Unfold everything, and show every case and number of threads."""
    open_all(driver)
    driver.execute_script("for (const one of document.querySelectorAll('[data-case], [data-threads]'))"
                          " one.classList.remove('other-case', 'other-threads')")


_CLIPPED = """
const found = [];
for (const cell of document.querySelectorAll("th, td")) {
  if (!cell.getClientRects().length) continue;
  const say = (why) => found.push([cell.textContent.trim().slice(0, 40), why]);
  if (cell.scrollWidth > cell.clientWidth + 1) say("wider than its cell");
  let box = cell.getBoundingClientRect();
  for (let node = cell.parentElement; node !== document.documentElement; node = node.parentElement) {
    const how = getComputedStyle(node).overflowX, room = node.getBoundingClientRect();
    if (how === "visible") continue;
    if (how === "auto" || how === "scroll") {
      const left = box.left - room.left - node.clientLeft + node.scrollLeft;
      if (left < -1 || left + box.width > node.scrollWidth + 1) say("out of reach");
      box = room;
    } else if (box.left < room.left - 1 || box.right > room.right + 1) say("cut off");
  }
  if (box.left < -1 || box.right > document.documentElement.clientWidth + 1) say("beyond the window");
}
return found;
"""


def clipped(driver):
    """Return (text, why) of the cells of tables that are shown and cannot be read whole, not even by scrolling a box."""
    return [tuple(item) for item in driver.execute_script(_CLIPPED)]


def console(driver):
    """Return what the console said since the page was loaded."""
    return [entry["message"] for entry in driver.get_log("browser")]


def requests(driver, path):
    """Return the addresses that were asked for since the page was loaded, without the page itself."""
    asked = []
    for entry in driver.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            asked.append(message["params"]["request"]["url"])
    asked += driver.execute_script("return performance.getEntriesByType('resource').map((e) => e.name)")
    return [address for address in asked
            if address not in (f"file://{path}", "about:blank") and not address.startswith("data:")]


_CONTRAST = """
const canvas = document.createElement("canvas").getContext("2d", {willReadFrequently: true});
const rgb = (colour) => { canvas.clearRect(0, 0, 1, 1); canvas.fillStyle = colour; canvas.fillRect(0, 0, 1, 1);
  return [...canvas.getImageData(0, 0, 1, 1).data]; };
const light = (colour) => colour.slice(0, 3).map((v) => v / 255)
  .map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
  .reduce((sum, v, at) => sum + v * [0.2126, 0.7152, 0.0722][at], 0);
const behind = (node) => { for (; node; node = node.parentElement) {
  const colour = rgb(getComputedStyle(node).backgroundColor); if (colour[3] === 255) return colour; }
  return [255, 255, 255, 255]; };
return [...document.querySelectorAll(arguments[0])].map((node) => {
  const style = getComputedStyle(node), paper = behind(node);
  const ink = rgb(node instanceof SVGElement ? style.fill : style.color);
  const [a, b] = [light(ink), light(paper)].sort((x, y) => y - x);
  return [node.textContent.slice(0, 40), ink.join(), paper.join(), (a + 0.05) / (b + 0.05)]; });
"""


def contrasts(driver, selector):
    """Return (text, ink, paper, contrast as of WCAG 2) of the elements."""
    return [tuple(item) for item in driver.execute_script(_CONTRAST, selector)]

"""Opens a study's page in a headless Chromium and holds that it works: no error on the console, nothing fetched, every plot and picture
decoded, a click shows the next picture, zoom stays the same for all of them.

    pip install playwright
    python3 tests/report/look_at_report.py study/report.html [--chromium /usr/bin/chromium] [--screenshot page.png]

Without --chromium, Playwright's own is used (`playwright install chromium`). Exits with 1 and says what does not hold.
"""

import argparse
import pathlib
import sys

from playwright.sync_api import sync_playwright


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--chromium")
    parser.add_argument("--screenshot", type=pathlib.Path)
    arguments = parser.parse_args()
    failures = []

    def holds(truth, words):
        print(("ok      " if truth else "FAILED  ") + words)
        if not truth:
            failures.append(words)

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=arguments.chromium, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1280, "height": 1600})
        said, fetched = [], []
        page.on("console", lambda message: said.append(message.text) if message.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: said.append(str(error)))
        page.on("request", lambda request: fetched.append(request.url))
        page.goto(arguments.page.resolve().as_uri())
        page.wait_for_load_state("load")
        holds(not said, f"nothing on the console {said}")
        elsewhere = [url for url in fetched if not url.startswith(("file:", "data:"))]
        holds(not elsewhere, f"nothing is fetched {elsewhere}")
        decoded = "images => images.length > 0 && images.every(i => i.complete && i.naturalWidth > 0)"
        holds(page.eval_on_selector_all("img.plot", decoded), f"{page.locator('img.plot').count()} plots are there")
        holds(page.eval_on_selector_all("img.layer", decoded), f"{page.locator('img.layer').count()} pictures are there")
        holds(page.locator("table").count() >= 3, f"{page.locator('table').count()} tables are there")

        viewer = page.locator(".viewer").first
        stage = viewer.locator(".stage")
        stage.scroll_into_view_if_needed()
        on = lambda: viewer.locator(".layer").evaluate_all("layers => layers.map(l => l.classList.contains('on'))")
        before = on()
        stage.click()
        after = on()
        holds(before[0] and after[1] and sum(after) == 1, "a click shows the next picture alone")
        box = stage.bounding_box()
        page.mouse.move(box["x"] + box["width"] / 3, box["y"] + box["height"] / 3)
        page.mouse.wheel(0, -480)
        moved = lambda: viewer.locator(".moved").evaluate("m => m.style.transform")
        page.wait_for_function("document.querySelector('.moved').style.transform.includes('scale(4)')")
        zoomed = moved()
        viewer.locator(".pick").first.click()
        holds(moved() == zoomed and on()[0], f"zoom stays the same for all pictures: {zoomed}")
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.mouse.down()
        page.mouse.move(box["x"] + box["width"] / 2 - 60, box["y"] + box["height"] / 2 - 20)
        page.mouse.up()
        holds(moved() != zoomed and on()[0], "a drag moves, and shows no other picture")
        viewer.locator(".whole").click()
        holds("scale(1)" in moved(), "and the whole picture comes back")
        if arguments.screenshot:
            page.screenshot(path=arguments.screenshot, full_page=True)
        browser.close()
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()

"""Headless Chromium for the report's test and its pictures. Needs Debian's chromium, chromium-driver, python3-selenium."""

import pathlib
import shutil
import tempfile

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait


class HeadlessBrowser:
    """A browser with a profile of its own that asks the network for nothing; use it in a with statement."""

    def __init__(self, width, height, *flags):
        self.profile = tempfile.mkdtemp()
        options = webdriver.ChromeOptions()
        for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--disable-background-networking", "--disable-component-update", "--disable-sync",
                     "--disable-default-apps", "--no-first-run", "--hide-scrollbars", f"--window-size={width},{height}",
                     f"--user-data-dir={self.profile}", *flags):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()
        shutil.rmtree(self.profile, ignore_errors=True)

    def open(self, file):
        self.driver.get(pathlib.Path(file).resolve().as_uri())

    def wait(self, condition, seconds=5):
        WebDriverWait(self.driver, seconds, poll_frequency=0.02).until(lambda driver: driver.execute_script(condition))

    def press(self, key):
        self.driver.switch_to.active_element.send_keys(key)

    def errors(self):
        """Messages of the console since the last call."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

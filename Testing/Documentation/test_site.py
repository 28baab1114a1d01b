#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The site of the documentation in a browser, opened from the disk: test_site.py SITE"""

import io
import json
import pathlib
import shutil
import sys
import tempfile
import time
import unittest

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import WebDriverWait
    from vtkmodules.vtkIOImage import vtkPNGReader
except ImportError as error:
    print(f"skipped: {error}; Utilities/build.sh names the packages of the night")
    sys.exit(0)

SITE = pathlib.Path(sys.argv.pop(1)).resolve()
# Seconds after which a page must have hung, however busy the machine is.
HANGING = 900
# Without a graphics card, and as root; nothing but files can be reached.
ARGUMENTS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--window-size=1200,900",
    "--proxy-server=127.0.0.1:9",
)

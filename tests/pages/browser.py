"""Drives one chromium without a window over the DevTools protocol, by a pair of pipes: opens pages, sends real input, and keeps what
scripts complain of."""

import base64
import json
import os
import subprocess
import time
from pathlib import Path

FLAGS = ("--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--allow-file-access-from-files", "--hide-scrollbars",
         "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run", "--disable-extensions")


class BrowserError(Exception):
    """The browser refused a command, or a script of this driver failed in the page."""


class Browser:
    """One chromium with one page. `errors` holds what scripts of the page that is open have thrown, and what did not load."""

    def __init__(self, chromium, folder):
        (read, self.out), (self.into, write) = os.pipe(), os.pipe()

        def connect():
            # The protocol uses the descriptors 3 and 4, which may belong to the pipes.
            ends = os.dup(read), os.dup(write)
            os.dup2(ends[0], 3)
            os.dup2(ends[1], 4)

        self.process = subprocess.Popen([chromium, *FLAGS, f"--user-data-dir={folder}"], preexec_fn=connect, close_fds=False,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(read)
        os.close(write)
        self.number, self.rest, self.events, self.errors, self.session = 0, b"", [], [], None
        target = self.send("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.send(f"{domain}.enable")

    def close(self):
        """Ends the browser."""
        self.session = None
        self.send("Browser.close")
        self.process.wait(20)

    def send(self, method, **parameters):
        """The answer to a command."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise BrowserError(f"{method}: {answer['error']}")
                return answer["result"]

    def receive(self):
        """The next message; complaints and events are kept."""
        while b"\0" not in self.rest:
            more = os.read(self.into, 1 << 20)
            if not more:
                raise BrowserError("chromium has ended")
            self.rest += more
        text, self.rest = self.rest.split(b"\0", 1)
        message = json.loads(text)
        self.keep(message.get("method"), message.get("params", {}))
        return message

    def keep(self, method, parameters):
        """Notes an event, and a complaint if it is one."""
        if method:
            self.events.append((method, parameters))
        if method == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.errors.append(f"{parameters['entry']['text']} {parameters['entry'].get('url', '')}")
        elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "assert"):
            self.errors.append(" ".join(str(one.get("value", one.get("description"))) for one in parameters["args"]))
        elif method == "Network.requestWillBeSent" and not parameters["request"]["url"].startswith(("file:", "data:", "blob:")):
            self.errors.append(f"asks for {parameters['request']['url'][:100]}")

    def open(self, page, width=1400, height=900, dark=False):
        """Opens a file in a window of that size and waits until it is loaded."""
        self.resize(width, height)
        self.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.errors.clear()
        self.events.clear()
        self.send("Page.navigate", url=Path(page).resolve().as_uri())
        while not any(method == "Page.loadEventFired" for method, _ in self.events):
            self.receive()

    def resize(self, width, height=900):
        """Gives the window another size."""
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def value(self, script):
        """The value of an expression in the page, awaited if it is a promise."""
        found = self.send("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in found:
            details = found["exceptionDetails"]
            raise BrowserError(details.get("exception", {}).get("description", details["text"]))
        return found["result"].get("value")

    def until(self, script, seconds=20):
        """Waits until an expression holds."""
        end = time.monotonic() + seconds
        while not self.value(f"!!({script})"):
            if time.monotonic() > end:
                raise BrowserError(f"does not become true: {script}; complaints: {self.errors}")
            time.sleep(0.02)

    def mouse(self, kind, place, **more):
        """A mouse event at a place of the window."""
        self.send("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], **more)

    def place(self, element, share=(0.5, 0.5)):
        """Scrolls an element, an expression, into view and returns where a share of it lies in the window."""
        return self.value(f"""(() => {{ const one = {element}; one.scrollIntoView({{ block: "center", behavior: "instant" }});
          const box = one.getBoundingClientRect(); return [box.left + {share[0]} * box.width, box.top + {share[1]} * box.height]; }})()""")

    def click(self, element):
        """A click as a hand does it."""
        place = self.place(element)
        self.mouse("mouseMoved", place)
        self.mouse("mousePressed", place, button="left", buttons=1, clickCount=1)
        self.mouse("mouseReleased", place, button="left", clickCount=1)

    def drag(self, element, begin, end):
        """Drags from one share of an element to another."""
        first = self.place(element, begin)
        last = self.place(element, end)
        self.mouse("mouseMoved", first)
        self.mouse("mousePressed", first, button="left", buttons=1, clickCount=1)
        for step in (0.3, 0.6, 1.0):
            self.mouse("mouseMoved", [a + step * (b - a) for a, b in zip(first, last)], button="left", buttons=1)
        self.mouse("mouseReleased", last, button="left", clickCount=1)

    def picture(self, file):
        """Writes what the window shows as PNG, for a person to look at."""
        Path(file).write_bytes(base64.b64decode(self.send("Page.captureScreenshot", format="png")["data"]))

"""A headless Chromium, driven over WebDriver (W3C) by chromedriver."""
import base64
import json
import re
import shutil
import subprocess
import urllib.request

DRIVER = shutil.which('chromedriver')
BROWSER = shutil.which('chromium')
ARGUMENTS = ['--headless=new', '--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader', '--use-gl=angle',
             '--use-angle=swiftshader', '--hide-scrollbars', '--disable-dev-shm-usage']


class Browser:
    """One window; close it."""

    def __init__(self, *more):
        self.driver = subprocess.Popen([DRIVER, '--port=0'], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        for line in self.driver.stdout:
            if found := re.search(r'started successfully on port (\d+)', line):
                self.root = f'http://127.0.0.1:{found[1]}'
                break
        options = {'binary': BROWSER, 'args': ARGUMENTS + list(more)}
        wanted = {'browserName': 'chrome', 'goog:chromeOptions': options,
                  'goog:loggingPrefs': {'browser': 'ALL', 'performance': 'ALL'}}
        self.session = ''
        self.session = '/session/' + self.post('/session', {'capabilities': {'alwaysMatch': wanted}})['sessionId']

    def call(self, path, data=None, method=None):
        request = urllib.request.Request(self.root + (self.session if path != '/session' else '') + path,
                                         None if data is None else json.dumps(data).encode(),
                                         {'Content-Type': 'application/json'}, method=method)
        with urllib.request.urlopen(request, timeout=120) as answer:
            return json.load(answer)['value']

    def post(self, path, data):
        return self.call(path, data)

    def open(self, file):
        self.post('/url', {'url': f'file://{file}'})

    def run(self, script, *arguments):
        """The value of a function's body."""
        return self.post('/execute/sync', {'script': script, 'args': list(arguments)})

    def size(self, width, height):
        self.post('/window/rect', {'width': width, 'height': height})

    def screenshot(self, file):
        file.write_bytes(base64.b64decode(self.call('/screenshot')))

    def pdf(self):
        return base64.b64decode(self.post('/print', {'background': True}))

    def as_printed(self):
        """The page on the screen as on paper: with the style of print, and what is made before printing."""
        self.post('/goog/cdp/execute', {'cmd': 'Emulation.setEmulatedMedia', 'params': {'media': 'print'}})
        self.run('window.dispatchEvent(new Event("beforeprint"))')

    def as_on_screen(self):
        self.post('/goog/cdp/execute', {'cmd': 'Emulation.setEmulatedMedia', 'params': {'media': ''}})

    def said(self):
        """What the page wrote to its console, and failed to load."""
        return [entry['message'] for entry in self.post('/se/log', {'type': 'browser'}) if entry['level'] == 'SEVERE']

    def requests(self):
        """Addresses that were asked for."""
        events = [json.loads(e['message'])['message'] for e in self.post('/se/log', {'type': 'performance'})]
        return [e['params']['request']['url'] for e in events if e['method'] == 'Network.requestWillBeSent']

    def close(self):
        try:
            self.call('', method='DELETE')
        finally:
            self.driver.kill()
            self.driver.wait()
            self.driver.stdout.close()

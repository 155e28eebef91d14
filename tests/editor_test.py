"""Editors with docs/scene.schema.json, through the JSON language server that VS Code, Neovim and Emacs run: mistakes
are underlined where they are, keys are offered, and what a key means is told. `make language-server` installs it."""
import glob
import json
import os
import re
import shutil
import subprocess
import unittest

SERVER = "build/language-server/node_modules/.bin/vscode-json-language-server"
SCHEMA = "file://" + os.path.abspath("docs/scene.schema.json")
ERROR = 1


def settings_of_the_docs():
    """What docs/scene-format.md tells VS Code and Emacs, for this schema."""
    with open("docs/scene-format.md", encoding="utf-8") as file:
        page = file.read().replace("file://SCHEMA", SCHEMA)
    code = json.loads("{" + re.search(r'```json\n("json\.schemas".*?)```', page, re.S)[1] + "}")
    emacs = re.search(r':fileMatch \["(.*?)"\] :url "(.*?)"', page)
    neovim = re.search(r'fileMatch = \{ "(.*?)" \}, url = "(.*?)"', page)
    return code["json.schemas"], emacs.groups(), neovim.groups()


class Server:
    """The server as an editor drives it: messages of JSON-RPC through its standard input and output."""

    def __init__(self):
        self.process = subprocess.Popen([SERVER, "--stdio"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.count = 0
        self.ask("initialize", {"processId": os.getpid(), "rootUri": None, "initializationOptions": {
            "handledSchemaProtocols": ["file"]}, "capabilities": {"textDocument": {
                "diagnostic": {}, "completion": {"completionItem": {"snippetSupport": False}},
                "hover": {"contentFormat": ["plaintext"]}}}})
        self.tell("initialized", {})

    def send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def tell(self, method, params):
        self.send({"method": method, "params": params})

    def receive(self):
        length = 0
        for line in iter(self.process.stdout.readline, b"\r\n"):
            if not line:
                raise EOFError("the language server ended")
            if line.lower().startswith(b"content-length:"):
                length = int(line.split(b":")[1])
        return json.loads(self.process.stdout.read(length))

    def ask(self, method, params):
        self.count += 1
        self.send({"id": self.count, "method": method, "params": params})
        while True:
            message = self.receive()
            if "method" not in message and message.get("id") == self.count:
                assert "error" not in message, message
                return message["result"]
            if "method" in message and "id" in message:
                self.send({"id": message["id"], "result": None})

    def close(self):
        self.ask("shutdown", None)
        self.tell("exit", None)
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()


class Settings(unittest.TestCase):
    def test_every_editor_is_told_the_same(self):
        code, emacs, neovim = settings_of_the_docs()
        self.assertEqual([(one["fileMatch"], one["url"]) for one in code], [(["scenes/*.json"], SCHEMA)])
        self.assertEqual(emacs, ("scenes/*.json", SCHEMA))
        self.assertEqual(neovim, emacs)


INSTALLED = os.path.exists(SERVER) and shutil.which("node") is not None


@unittest.skipUnless(INSTALLED, "no language server")
class Editor(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = Server()
        schemas, _, _ = settings_of_the_docs()
        cls.server.tell("workspace/didChangeConfiguration", {"settings": {"json": {"validate": {"enable": True},
                                                                                   "schemas": schemas}}})
        cls.opened = 0

    @classmethod
    def tearDownClass(cls):
        cls.server.close()

    def open(self, text, name="scenes/new-%d.json"):
        """The place of a new document with that text."""
        Editor.opened += 1
        uri = "file:///" + (name % self.opened if "%" in name else name)
        self.server.tell("textDocument/didOpen", {"textDocument": {"uri": uri, "languageId": "json", "version": 1,
                                                                   "text": text}})
        return {"uri": uri}

    def faults(self, text, **where):
        return self.server.ask("textDocument/diagnostic", {"textDocument": self.open(text, **where)})["items"]

    def at(self, text, method):
        """What the server says of the place that the text marks by |."""
        before = text[:text.index("|")]
        line = before.count("\n")
        return self.server.ask(method, {
            "textDocument": self.open(text.replace("|", "", 1)),
            "position": {"line": line, "character": len(before) - (before.rfind("\n") + 1)}})

    def offered(self, text):
        return {item["label"] for item in self.at(text, "textDocument/completion")["items"]}

    def test_every_scene_is_right(self):
        scenes = glob.glob("scenes/**/*.json", recursive=True)
        self.assertGreater(len(scenes), 5)
        for scene in scenes:
            with open(scene, encoding="utf-8") as file:
                self.assertEqual(self.faults(file.read()), [], scene)

    def test_a_mistake_is_underlined_where_it_is(self):
        with open("scenes/original.json", encoding="utf-8") as file:
            text = file.read()
        for good, bad, underlined in (('"columns": ', '"columns": -', r"-\d+"), ('"rows"', '"rosw"', '"rosw"'),
                                      ('"position": [', '"position": [true, ', "true")):
            wrong = text.replace(good, bad, 1)
            self.assertNotEqual(wrong, text)
            lines = wrong.split("\n")
            found = []
            for fault in self.faults(wrong):
                start, end = fault["range"]["start"], fault["range"]["end"]
                if start["line"] == end["line"]:
                    found.append(lines[start["line"]][start["character"]:end["character"]])
            self.assertTrue(any(re.fullmatch(underlined, part) for part in found), f"{bad}: {found}")

    def test_the_schema_that_a_scene_names_is_taken(self):
        text = json.dumps({"$schema": SCHEMA, "camera": {}, "screen": {}})
        said = [fault["message"] for fault in self.faults(text, name="a/b.json")]
        self.assertIn('Missing property "position".', said)

    def test_a_file_elsewhere_is_none_of_the_schemas(self):
        self.assertEqual(self.faults('{"camera": 7}', name="a/c.json"), [])

    def test_keys_and_words_are_offered(self):
        with open("docs/scene.schema.json", encoding="utf-8") as file:
            parts = json.load(file)["$defs"]
        self.assertEqual(self.offered('{\n  |\n}') - {"//"}, set(parts["scene"]["properties"]) - {"//"})
        keys = set(parts["camera"]["properties"])
        self.assertEqual(self.offered('{"camera": {"position": [0, 0, 0], |}}') - {"//"}, keys - {"position", "//"})
        self.assertEqual(self.offered('{"shading": {"viewer": |}}'), {'"camera"', '"ray"'})

    def test_the_meaning_of_a_key_is_told(self):
        told = self.at('{"li|ghts": []}', "textDocument/hover")["contents"]
        plain = json.dumps(told).replace("\\", "")  # what Markdown would read as marks is escaped
        self.assertIn("Point lights. Without any, no surface adds light.", plain)


if __name__ == "__main__":
    if not INSTALLED:
        print("SKIPPED: what a language server says with the schema; make language-server installs one in build/")
    unittest.main(verbosity=2)

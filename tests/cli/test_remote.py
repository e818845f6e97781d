#!/usr/bin/env python3
"""aerom towards a daemon that answers as it is told. Needs AEROM, the program. Python 3 standard library."""

import http.server
import json
import socket
import threading
import time
import unittest

from program import CASES, aerom


class Scripted(http.server.BaseHTTPRequestHandler):
    """Answers each request with the next (status, document) of the server's script and keeps what
    was asked."""

    def answer(self):
        size = int(self.headers.get("Content-Length", 0))
        self.server.asked.append((self.command, self.path, self.rfile.read(size).decode(),
                                  self.headers.get("Content-Type")))
        status, document = self.server.script.pop(0)
        body = (document if isinstance(document, str) else json.dumps(document)).encode()
        self.send_response(status)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    do_GET = do_POST = do_DELETE = answer

    def log_message(self, *_):
        pass


def job(state, **more):
    return dict({"id": "0190-a", "kind": "simulation", "state": state, "progress": 0.5, "name": "x"},
                **more)


class Remote(unittest.TestCase):
    """The client alone, against a server that plays a script."""

    def setUp(self):
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Scripted)
        self.server.asked = []
        self.thread = threading.Thread(target=self.server.serve_forever, daemon=True)
        self.thread.start()
        self.url = "http://127.0.0.1:%d" % self.server.server_port

    def tearDown(self):
        self.server.shutdown()
        self.server.server_close()
        self.thread.join()

    def play(self, *script, arguments):
        self.server.script = list(script)
        result = aerom(*arguments, url=self.url)
        self.assertEqual(self.server.script, [], "not every answer was asked for")
        return result

    def test_submit_sends_the_file_as_it_is(self):
        path = CASES / "aluminium-modes.json"
        result = self.play((202, job("queued")), (200, dict(job("done"), reused=True)),
                           arguments=["submit", path, path])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, "0190-a queued %s\n0190-a done %s (reused)\n" % (path, path))
        sent = ("POST", "/v1/jobs", path.read_text(encoding="utf-8"), "application/json")
        self.assertEqual(self.server.asked, [sent, sent])

    def test_submit_goes_on_after_a_refused_case(self):
        path = CASES / "aluminium-modes.json"
        problem = {"title": "The case is not admissible", "status": 422, "errors": [
            {"pointer": "/beam/length_m", "code": "range", "detail": "is not positive",
             "expected": "> 0", "got": "-1"}]}
        result = self.play((422, problem), (202, job("queued")), arguments=["submit", path, path])
        self.assertEqual(result.returncode, 1)
        self.assertIn("422 The case is not admissible", result.stderr)
        self.assertIn("/beam/length_m: is not positive (expected > 0, got -1)", result.stderr)
        self.assertEqual(result.stdout.count("\n"), 1)

    def test_submit_wait(self):
        result = self.play((202, job("queued")), (200, job("running")), (200, job("done")),
                           arguments=["submit", "--wait", CASES / "aluminium-modes.json"])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([a[1] for a in self.server.asked],
                         ["/v1/jobs", "/v1/jobs/0190-a", "/v1/jobs/0190-a"])

    def test_wait_tells_how_a_job_ended(self):
        failed = job("failed", error={"code": "not_finite", "detail": "at 0.3 s"})
        for final, code in ((job("done"), 0), (failed, 1), (job("cancelled"), 1)):
            with self.subTest(state=final["state"]):
                result = self.play((200, job("running")), (200, final), arguments=["wait", "0190-a"])
                self.assertEqual(result.returncode, code)
                self.assertEqual(result.stdout, "")
        self.assertIn("at 0.3 s", self.play((200, failed), arguments=["wait", "1"]).stderr)

    def test_wait_gives_up(self):
        start = time.monotonic()
        result = self.play((200, job("running")), arguments=["wait", "1", "--timeout", "0"])
        self.assertEqual(result.returncode, 3)
        self.assertLess(time.monotonic() - start, 10)

    def test_get_and_cancel(self):
        for word, path in (("summary", "/summary"), ("case", "/case"), ("modes", "/modes"),
                           ("damping", "/damping"), ("loads", "/loads"), ("section", "/section"), ("series", "/series"),
                           ("job", "")):
            self.server.asked.clear()
            result = self.play((200, {"a": 1}), arguments=["get", "j", word])
            self.assertEqual((result.returncode, result.stdout), (0, '{"a": 1}\n'))
            self.assertEqual(self.server.asked[0][:2], ("GET", "/v1/jobs/j" + path))
        self.server.asked.clear()
        result = self.play((202, job("cancelling")), arguments=["cancel", "j"])
        self.assertEqual((result.returncode, result.stdout), (0, "0190-a cancelling\n"))
        self.assertEqual(self.server.asked[0][:2], ("DELETE", "/v1/jobs/j"))

    def test_list(self):
        result = self.play((200, {"jobs": [job("done", verdict="stable")], "next": None}),
                           arguments=["list", "--state", "done", "--kind", "simulation",
                                      "--limit", "5"])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.split(), ["0190-a", "simulation", "done", "50", "%", "stable", "x"])
        self.assertEqual(self.server.asked[0][1], "/v1/jobs?state=done&kind=simulation&limit=5")

    def test_ids_cannot_change_the_path(self):
        for name in ("../polars", "..", "a/b", "a?b", "", "a%2e"):
            with self.subTest(id=name):
                result = self.play(arguments=["get", name])
                self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertEqual(self.server.asked, [])

    def test_answers_that_are_no_documents(self):
        for body in ("", "<html>", "[]", "{}", '{"id": 5}'):
            with self.subTest(body=body):
                self.assertEqual(self.play((200, body), arguments=["wait", "j"]).returncode, 1)
        self.assertEqual(self.play((502, "<html>bad gateway"), arguments=["show", "j"]).returncode, 1)
        self.assertEqual(self.play((200, "<html>"), arguments=["list"]).returncode, 1)

    def test_nobody_there(self):
        with socket.socket() as s:
            s.bind(("127.0.0.1", 0))
            closed = "http://127.0.0.1:%d" % s.getsockname()[1]
        result = aerom("list", "--url", closed)
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn(closed, result.stderr)


if __name__ == "__main__":
    unittest.main()

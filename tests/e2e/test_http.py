"""The adaptor: bad input and hostile framing on real sockets."""
import json
import socket
import time

from daemon import DaemonTest, simulation


class Http(DaemonTest):
    def setUp(self):
        super().setUp()
        self.d = self.start("--workers", "0").wait_ready()

    def raw(self, data, half_close=False):
        """Sends bytes, returns (status, everything that came back)."""
        with socket.create_connection(("127.0.0.1", self.d.port), timeout=20) as s:
            s.sendall(data)
            if half_close:
                s.shutdown(socket.SHUT_WR)
            got = b""
            while True:
                try:
                    piece = s.recv(65536)
                except ConnectionResetError:
                    break
                got += piece
                if not piece or (b"\r\n\r\n" in got and b"Connection: close" not in got):
                    break
        return (int(got.split()[1]) if got else 0), got

    def assert_alive(self):
        self.assertEqual(self.d.request("GET", "/healthz")[0], 200)
        self.assertEqual(self.d.request("GET", "/v1/jobs")[2]["jobs"], [])

    def test_bad_documents(self):
        good = simulation()

        def changed(path, value):
            case = json.loads(json.dumps(good))
            at = case
            for key in path[:-1]:
                at = at[key]
            if value is None:
                del at[path[-1]]
            else:
                at[path[-1]] = value
            return case

        text = json.dumps(good)
        bodies = [
            ("malformed", "{", None),
            ("empty", "", None),
            ("trailing text", text + " x", None),
            ("duplicate key", text.replace('"kind":', '"kind": "modes", "kind":'), "/kind"),
            ("unknown key", changed(("flow", "sped"), 1), "/flow/sped"),
            ("1e999", text.replace('"speed_m_s": 6.0', '"speed_m_s": 1e999'), None),
            ("NaN", text.replace('"speed_m_s": 6.0', '"speed_m_s": NaN'), None),
            ("deep", "[" * 100 + "]" * 100, None),
            ("missing material", changed(("beam", "section", "layup", 0, "material"), "gold"),
             "/beam/section/layup/0/material"),
            ("negative thickness", changed(("beam", "section", "layup", 0, "thickness_m"), -1e-4),
             "/beam/section/layup/0/thickness_m"),
            ("no elements", changed(("beam", "elements"), 0), "/beam/elements"),
            ("too many modes", changed(("solver", "modes"), 10000), "/solver/modes"),
            ("speed 0", changed(("flow", "speed_m_s"), 0), "/flow/speed_m_s"),
            ("no polar", changed(("aerodynamics", "polar"), "none"), "/aerodynamics/polar"),
            ("empty list", changed(("beam", "section", "layup"), []), "/beam/section/layup"),
            ("empty batch", {"jobs": []}, "/jobs"),
            ("missing field", changed(("beam", "length_m"), None), "/beam/length_m"),
        ]
        for name, body, pointer in bodies:
            with self.subTest(name):
                status, headers, problem = self.d.request("POST", "/v1/jobs", body)
                self.assertIn(status, (400, 422), problem)
                self.assertEqual(headers["Content-Type"], "application/problem+json")
                if pointer is not None:
                    self.assertIn(pointer, [e["pointer"] for e in problem["errors"]])
        self.assert_alive()

    def test_bad_requests(self):
        d = self.d
        job = "/v1/jobs/00000000-0000-7000-8000-000000000000"
        for method, path, headers, expected in [
                ("GET", "/nowhere", {}, 404), ("GET", job, {}, 404), ("DELETE", job, {}, 404),
                ("GET", job + "/series", {}, 404), ("PUT", "/v1/jobs", {}, 405),
                ("POST", "/v1/jobs", {"Content-Type": "text/plain"}, 415),
                ("GET", "/v1/jobs?limit=0", {}, 400), ("GET", "/v1/jobs?state=odd", {}, 400)]:
            with self.subTest(method + path):
                status, got, problem = d.request(method, path, "{}" if headers else None, headers)
                self.assertEqual(status, expected, problem)
                self.assertEqual(got["Content-Type"], "application/problem+json")
                self.assertEqual(problem["status"], expected)
                if expected == 405:
                    self.assertIn("POST", got["Allow"])
        self.assert_alive()

    def test_body_over_the_limit(self):
        size = 64 << 20
        status, got = self.raw(b"POST /v1/jobs HTTP/1.1\r\nHost: x\r\nContent-Type: application/json"
                               b"\r\nContent-Length: %d\r\n\r\n" % size)
        self.assertEqual(status, 413)  # before a byte of the body was sent
        self.assertIn(b"application/problem+json", got)
        # Without a length: counted while it comes.
        chunk = b"10000\r\n" + b" " * 0x10000 + b"\r\n"
        with socket.create_connection(("127.0.0.1", self.d.port), timeout=20) as s:
            s.sendall(b"POST /v1/jobs HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
                      b"Transfer-Encoding: chunked\r\n\r\n")
            try:
                for _ in range(2048):
                    s.sendall(chunk)
                s.sendall(b"0\r\n\r\n")
                answer = s.recv(4096)
            except (BrokenPipeError, ConnectionResetError):
                answer = b""  # cut off: fine too
        self.assertTrue(answer == b"" or b" 413 " in answer, answer)
        self.assert_alive()

    def test_framing(self):
        post = b"POST /v1/jobs HTTP/1.1\r\nContent-Type: application/json\r\n"
        for name, data in [
                ("two lengths", post + b"Host: x\r\nContent-Length: 2\r\nContent-Length: 2\r\n\r\n{}"),
                ("two different lengths",
                 post + b"Host: x\r\nContent-Length: 2\r\nContent-Length: 3\r\n\r\n{}"),
                ("length and chunked", post + b"Host: x\r\nContent-Length: 2\r\n"
                 b"Transfer-Encoding: chunked\r\n\r\n2\r\n{}\r\n0\r\n\r\n"),
                ("unknown coding",
                 post + b"Host: x\r\nTransfer-Encoding: gzip\r\n\r\n2\r\n{}\r\n0\r\n\r\n"),
                ("no host", b"GET /healthz HTTP/1.1\r\n\r\n"),
                ("two hosts", b"GET /healthz HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n"),
                ("zero byte in the query", b"GET /v1/jobs?name=a%00b HTTP/1.1\r\nHost: x\r\n\r\n"),
                ("bad escape", b"GET /v1/jobs?name=%zz HTTP/1.1\r\nHost: x\r\n\r\n"),
                ("absolute target", b"GET http://x/healthz HTTP/1.1\r\nHost: x\r\n\r\n"),
                ("too many parameters", b"GET /v1/jobs?" + b"a=1&" * 40 +
                 b" HTTP/1.1\r\nHost: x\r\n\r\n")]:
            with self.subTest(name):
                self.assertEqual(self.raw(data)[0], 400)
        self.assertIn(self.raw(b"GET /healthz HTTP/1.1\r\nHost: x\r\nX: " + b"a" * 100000 +
                               b"\r\n\r\n")[0], (0, 413, 431))
        self.assert_alive()

    def test_pipelined_and_kept_open(self):
        request = b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n"
        with socket.create_connection(("127.0.0.1", self.d.port), timeout=20) as s:
            s.sendall(request * 10)
            got = b""
            while got.count(b"HTTP/1.1 200") < 10:
                piece = s.recv(65536)
                self.assertTrue(piece, got)
                got += piece

    def test_client_that_leaves_while_it_waits(self):
        body = json.dumps(simulation()).encode()
        head = (b"POST /v1/jobs HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
                b"Content-Length: %d\r\n\r\n" % len(body))
        for cut in (20, len(head), len(head) + 10, len(head) + len(body)):
            for _ in range(25):
                with socket.create_connection(("127.0.0.1", self.d.port), timeout=20) as s:
                    s.sendall((head + body)[:cut])
        self.assertEqual(self.d.request("GET", "/healthz")[0], 200)
        self.assertLessEqual(len(self.d.request("GET", "/v1/jobs")[2]["jobs"]), 1)
        self.assertEqual(self.d.stop(), 0)

    def test_slow_header_is_cut_off(self):
        start = time.monotonic()
        with socket.create_connection(("127.0.0.1", self.d.port), timeout=40) as s:
            s.settimeout(0.5)
            ended = False
            while not ended and time.monotonic() - start < 30:
                try:
                    s.sendall(b"G")
                    ended = s.recv(100) == b""
                except socket.timeout:
                    pass
                except OSError:
                    ended = True
        self.assertTrue(ended)
        self.assertLess(time.monotonic() - start, 15)
        self.d.wait_log("http_late")

    def test_repeated_suspension(self):
        """Each submit suspends its connection until the commit: none may be forgotten."""
        import http.client
        connection = http.client.HTTPConnection("127.0.0.1", self.d.port, timeout=20)
        for i in range(300):
            connection.request("POST", "/v1/jobs", json.dumps(simulation(speed=1 + 0.01 * i)),
                               {"Content-Type": "application/json"})
            response = connection.getresponse()
            response.read()
            self.assertEqual(response.status, 202)
        connection.close()

"""Entries of users in the library: kept, versioned, visible to later cases, gone when deleted."""
import signal

from daemon import DaemonTest


def network(name, b1, **more):
    """One neuron in its linear range: c_l + b1 + 0.5 of the rate of the angle."""
    return {"name": name, "activation": "tanh", "inputs": ["alpha_rate"], "outputs": ["cl"],
            "hidden": 1, "input_offset": [0], "input_scale": [1], "output_offset": [b1],
            "output_scale": [1], "hull_min": [-1], "hull_max": [1], "w1": [[1e-4]], "b1": [0],
            "w2": [[5e3]], "b2": [0], **more}


def loop(name):
    return {"schema_version": 1, "kind": "loop",
            "aerodynamics": {"polar": "flat-plate-linear",
                             "dynamic": {"type": "network", "name": name}},
            "motion": {"type": "sine", "frequency_c_v": 0.1, "cycles": 1}}


class Library(DaemonTest):
    def test_versions_survive_and_serve_cases(self):
        d = self.start().wait_ready()
        self.assertEqual(d.request("POST", "/v1/networks", network("own", 0.25))[0], 201)
        status, headers, kept = d.request("POST", "/v1/networks", network("own", 0.5))
        self.assertEqual((status, headers["Location"], kept["version"]),
                         (201, "/v1/networks/own", 2))
        status, _, again = d.request("POST", "/v1/networks", network("own", 0.25))
        self.assertEqual((status, again["version"], again["reused"]), (200, 1, True))
        d.process.send_signal(signal.SIGKILL)
        d.process.wait()

        d = self.start().wait_ready()
        _, _, listed = d.request("GET", "/v1/networks")
        mine = [e for e in listed["networks"] if not e["built_in"]]
        self.assertEqual([(e["name"], e["version"]) for e in mine], [("own", 1), ("own", 2)])
        for reference, cl in (("own", 0.5), ("own@1", 0.25)):
            job = d.submit(loop(reference))
            self.assertEqual(d.wait(job)["state"], "done")
            _, _, summary = d.request("GET", f"/v1/jobs/{job}/summary")
            self.assertAlmostEqual(summary["cl"]["max"], cl, delta=1e-12)
            self.assertEqual(summary["identity"]["network"]["name"], "own")
        self.assertEqual(d.request("DELETE", "/v1/networks/own")[0], 204)
        self.assertEqual(d.request("GET", "/v1/networks/own")[0], 404)
        status, _, problem = d.request("POST", "/v1/jobs", loop("own@1"))
        self.assertEqual((status, problem["errors"][0]["pointer"]),
                         (422, "/aerodynamics/dynamic/name"))
        # A deleted version never comes back as another content.
        self.assertEqual(d.request("POST", "/v1/networks", network("own", 1))[2]["version"], 3)
        # The case keeps what it needs.
        _, _, case = d.request("GET", f"/v1/jobs/{job}/case")
        self.assertEqual(case["networks"][0]["output_offset"], [0.25])
        self.assertTrue(d.request("POST", "/v1/jobs", case)[2]["reused"])

    def test_built_in_entries_stay(self):
        d = self.start().wait_ready()
        _, _, polar = d.request("GET", "/v1/polars/flat-plate-linear")
        for answer in (d.request("POST", "/v1/polars", polar),
                       d.request("DELETE", "/v1/polars/flat-plate-linear")):
            self.assertEqual((answer[0], answer[2]["code"]), (409, "built_in"))

"""Datasets over HTTP: uploads, what is refused of them, what is shown, and a network trained on one."""
import csv
import io
import json
import math
import xml.etree.ElementTree

from daemon import DaemonTest, simulation

COLUMNS = ["t", "alpha_deg", "alpha_dot", "alpha_ddot", "w", "w_dot", "w_ddot", "cl", "cd", "cm"]


def sine(name, amplitude_deg, frequency, slope=2 * math.pi, cycles=3, n=150):
    """A pitching plate: c_l = slope alpha + 0.8 of its rate, c_m follows the rate."""
    omega, a = 2 * math.pi * frequency, math.radians(amplitude_deg)
    rows = {k: [] for k in COLUMNS}
    for i in range(n):
        t = i * cycles / frequency / n
        s, c = math.sin(omega * t), math.cos(omega * t)
        values = [t, amplitude_deg * s, a * omega * c, -a * omega ** 2 * s, 0, 0, 0,
                  slope * a * s + 0.8 * a * omega * c, 0.05 + 0.01 * s * s,
                  0.5 * math.pi * a * s - 0.4 * a * omega * c]
        for k, v in zip(COLUMNS, values):
            rows[k].append(v)
    return {"name": name, "period_c_v": 1 / frequency, "start_c_v": 0, **rows}


def dataset(name="own", **more):
    return {"name": name, "description": "made up", **more,
            "records": [sine(f"a{a}_f{f}", a, f) for a in (2, 4) for f in (0.06, 0.1, 0.15)]}


def as_csv(data):
    out = io.StringIO()
    rows = csv.writer(out, lineterminator="\n")
    rows.writerow(["record", "period_c_v", "start_c_v", *COLUMNS])
    for r in data["records"]:
        for line in zip(*(r[k] for k in COLUMNS)):
            rows.writerow([r["name"], r["period_c_v"], r["start_c_v"], *map(repr, line)])
    return out.getvalue()


class Datasets(DaemonTest):
    def test_json_and_csv_are_one(self):
        d = self.start().wait_ready()
        status, headers, kept = d.request("POST", "/v1/datasets", dataset())
        self.assertEqual((status, headers["Location"], kept["version"]),
                         (201, "/v1/datasets/own", 1), kept)
        status, _, again = d.request("POST", "/v1/datasets?name=own", as_csv(dataset()).encode(),
                                     {"Content-Type": "text/csv"})
        self.assertEqual((status, again["reused"], again["hash"]), (200, True, kept["hash"]), again)
        _, _, item = d.request("GET", "/v1/datasets/own")
        self.assertEqual((item["description"], item["count"], item["samples"]), ("made up", 6, 900))
        self.assertEqual([r["name"] for r in item["records"]],
                         [r["name"] for r in dataset()["records"]])
        self.assertAlmostEqual(item["records"][0]["alpha_deg"]["max"], 2, delta=0.01)
        _, _, text = d.request("GET", "/v1/datasets/own?format=csv")
        status, _, copy = d.request("POST", "/v1/datasets?name=copy", text,
                                    {"Content-Type": "text/csv"})
        self.assertEqual((status, copy["hash"]), (201, kept["hash"]))
        _, _, record = d.request("GET", "/v1/datasets/own/records/a2_f0.1")
        self.assertEqual(len(record["cl"]), 150)
        status, headers, svg = d.request("GET", "/v1/datasets/own/records/a2_f0.1.svg")
        self.assertEqual((status, headers["Content-Type"]), (200, "image/svg+xml"))
        self.assertTrue(xml.etree.ElementTree.fromstring(svg).tag.endswith("svg"))
        self.assertEqual(d.request("GET", "/v1/datasets/own/records/none")[0], 404)
        self.assertEqual(d.request("GET", "/v1/datasets/own?format=svg")[0], 400)
        self.assertEqual(d.request("DELETE", "/v1/datasets/own")[0], 204)
        self.assertEqual(d.request("GET", "/v1/datasets/own")[0], 404)

    def test_shipped(self):
        d = self.start().wait_ready()
        _, _, listed = d.request("GET", "/v1/datasets")
        self.assertEqual([(e["name"], e["built_in"]) for e in listed["datasets"]],
                         [("plate-4pct", True)])
        _, _, item = d.request("GET", "/v1/datasets/plate-4pct")
        self.assertGreater(item["count"], 20)
        self.assertEqual(len(item["records"]), item["count"])
        self.assertEqual(d.request("DELETE", "/v1/datasets/plate-4pct")[0], 409)
        self.assertEqual(d.request("POST", "/v1/datasets", dataset("plate-4pct"))[0], 409)

    def test_refusals(self):
        d = self.start().wait_ready()

        def changed(**columns):
            data = dataset()
            for key, change in columns.items():
                data["records"][1][key] = change(data["records"][1][key])
            return data

        def replaced(i, v):
            return lambda x: x[:i] + [v] + x[i + 1:]

        for data, pointer, code in (
                (changed(t=lambda x: x[:70] + [v + 1 for v in x[70:]]), "/records/1/t", "gap"),
                (changed(t=lambda x: replaced(70, x[69])(x)), "/records/1/t", "not_increasing"),
                (changed(alpha_deg=lambda x: [v * 57.3 for v in x]), "/records/1/alpha_deg",
                 "out_of_range"),
                (changed(alpha_dot=lambda x: [v * 57.3 for v in x]), "/records/1/alpha_dot",
                 "contradiction"),
                (changed(cl=lambda x: [0.3] * len(x)), "/records/1/cl", "constant"),
                (changed(cm=lambda x: x[:-1]), "/records/1/cm", "wrong_length"),
                (changed(cm=replaced(3, None)), "/records/1/cm/3", "wrong_type"),
                (changed(start_c_v=lambda x: 1e6), "/records/1/start_c_v", "out_of_range"),
                (changed(name=lambda x: "a2_f0.06"), "/records/1/name", "duplicate_name"),
                (changed(name=lambda x: "a b"), "/records/1/name", "bad_name"),
                ({**dataset(), "records": dataset()["records"][:1]}, "/records", "too_few"),
                ({**dataset(), "records": []}, "/records", "too_few"),
                ({"records": dataset()["records"]}, "/name", "required"),
                ({**dataset(), "units": "deg"}, "/units", "unknown_key")):
            with self.subTest(pointer=pointer, code=code):
                status, _, problem = d.request("POST", "/v1/datasets", data)
                self.assertEqual((status, problem["code"]), (422, "invalid_entry"), problem)
                self.assertIn((pointer, code),
                              [(e["pointer"], e["code"]) for e in problem["errors"]])
        text = as_csv(dataset())
        for body, pointer, code in (
                (text.replace("alpha_dot", "rate"), "/lines/1", "unknown_key"),
                (text.replace(",cm\n", "\n", 1), "/lines/1", "required"),
                (text.replace(",cl,", ",", 1), "/lines/1", "required"),
                (text.replace("\n", "\nx,1\n", 1), "/lines/2", "wrong_length"),
                (text.replace("\na2_f0.06,", "\na2_f0.06,x", 1), "/lines/2", "wrong_type"),
                ("", "/lines/1", "unknown_key")):
            with self.subTest(pointer=pointer, code=code):
                status, _, problem = d.request("POST", "/v1/datasets?name=own", body.encode(),
                                               {"Content-Type": "text/csv"})
                self.assertEqual((status, problem["errors"][0]["pointer"],
                                  problem["errors"][0]["code"]), (422, pointer, code), problem)
        for type_, target, status in (("text/plain", "?name=own", 415), ("text/csv", "", 422),
                                      ("application/json", "", 400)):
            self.assertEqual(d.request("POST", "/v1/datasets" + target, b"{",
                                       {"Content-Type": type_})[0], status)
        self.assertEqual(len(d.request("GET", "/v1/datasets")[2]["datasets"]), 1)


def training(**more):
    return {"schema_version": 1, "kind": "training", "name": "small net",
            "training": {"network": "small", "dataset": "own", "polar": "flat-plate-linear",
                         "inputs": ["delta_alpha", "alpha_rate"], "hidden": 4, "epochs": 60,
                         "samples_max": 60, "anchors": 20, "held_share": 0.2, **more}}


class Training(DaemonTest):
    def test_upload_train_and_use(self):
        """What the records have beyond the polar is 0.8 (c_l) and -0.4 (c_m) of the rate: the network
        learns it, and the next case uses it."""
        d = self.start().wait_ready()
        _, _, kept = d.request("POST", "/v1/datasets", dataset())
        job = d.submit(training())
        self.assertEqual(d.wait(job)["state"], "done")
        _, _, summary = d.request("GET", f"/v1/jobs/{job}/summary")
        self.assertEqual(summary["identity"]["dataset"], {"name": "own@1", "hash": kept["hash"]})
        member, = summary["members"]
        self.assertEqual((summary["records"], member["records_held"]), (6, 1))
        self.assertLess(summary["held"]["cl_rms_of_range"], 0.005)
        self.assertGreater(summary["held"]["cl_rms_of_range_polar"], 0.015)
        _, _, curves = d.request("GET", f"/v1/jobs/{job}/training")
        held = curves["members"][0]["curve"]["held"]
        self.assertEqual(len(held), member["epochs"] + 1)
        self.assertEqual(min(held), member["mean_square_error_held"])
        self.assertEqual([r["name"] for r in curves["records"]],
                         [r["name"] for r in dataset()["records"]])
        self.assertEqual([r["part"] for r in curves["records"]].count("held"), 1)

        _, _, network = d.request("GET", "/v1/networks/small")
        self.assertEqual((network["version"], network["job"], network["hash"]),
                         (1, job, summary["network"]["hash"]))
        self.assertEqual(network["provenance"]["dataset_hash"], kept["hash"])
        self.assertEqual(network["provenance"]["definition"]["seed"], 1)
        _, _, document = d.request("GET", f"/v1/jobs/{job}/network")
        self.assertEqual(document["w1"], network["w1"])

        use = d.submit({"schema_version": 1, "kind": "loop",
                        "aerodynamics": {"polar": "flat-plate-linear",
                                         "dynamic": {"type": "network", "name": "small"}},
                        "motion": {"type": "sine", "amplitude_deg": 3, "frequency_c_v": 0.1,
                                   "cycles": 1}})
        self.assertEqual(d.wait(use)["state"], "done")
        _, _, series = d.request("GET", f"/v1/jobs/{use}/series?channels=cl,alpha_deg")
        cl, alpha = (series["channels"][k]["value"] for k in ("cl", "alpha_deg"))
        rate = math.radians(3) * 2 * math.pi * 0.1
        self.assertAlmostEqual(cl[0], 0.8 * rate, delta=0.05 * rate)
        self.assertAlmostEqual(cl[100], 2 * math.pi * math.radians(3), delta=0.05 * rate)
        self.assertAlmostEqual(alpha[100], 3, delta=1e-9)

        # The same definition is the same job; another seed makes the next version.
        self.assertTrue(d.request("POST", "/v1/jobs", training())[2]["reused"])
        second = d.submit(training(seed=2))
        self.assertEqual(d.wait(second)["state"], "done")
        self.assertEqual(d.request("GET", "/v1/networks/small")[2]["version"], 2)

    def test_lags_on_a_base(self):
        """Members of a network with lags on attached flow, trained on some of the flow computations.
        In the motion of a record the kind `loop` finds the work the training has reported, and the
        network is for its polar only."""
        d = self.start().wait_ready()
        _, _, text = d.request("GET", "/v1/datasets/plate-4pct?format=csv")
        lines = text.decode().splitlines()
        names = [r["name"] for r in d.request("GET", "/v1/datasets/plate-4pct")[2]["records"]
                 if r["name"].startswith("pitch_m2.5") and "step" not in r["name"]][:4]
        self.assertIn("pitch_m2.5_a5_f0.125", names)
        part = "\n".join([lines[0]] + [x for x in lines[1:] if x.split(",")[0] in names]) + "\n"
        self.assertEqual(d.request("POST", "/v1/datasets?name=part", part.encode(),
                                   {"Content-Type": "text/csv"})[0], 201)
        job = d.submit({"schema_version": 1, "kind": "training",
                        "training": {"network": "lags", "dataset": "part",
                                     "polar": "plate-4pct-channel", "base": "attached",
                                     "lags_c_v": [0.5, 4],
                                     "inputs": ["alpha", "alpha_lag_1", "alpha_lag_2"],
                                     "hidden": 4, "members": 2, "samples_max": 60, "anchors": 60,
                                     "epochs": 40}})
        self.assertEqual(d.wait(job)["state"], "done")
        _, _, network = d.request("GET", "/v1/networks/lags")
        _, _, polar = d.request("GET", "/v1/polars/plate-4pct-channel")
        self.assertEqual((network["base"], network["lags_c_v"], network["hidden"]),
                         ("attached", [0.5, 4], 8))
        self.assertEqual(network["polar_hash"], polar["hash"])
        _, _, curves = d.request("GET", f"/v1/jobs/{job}/training")
        self.assertEqual([m["seed"] for m in curves["members"]], [1, 2])
        record, = (r for r in curves["records"] if r["name"] == "pitch_m2.5_a5_f0.125")
        self.assertLess(record["cl_rms"], 0.5 * record["cl_rms_polar"])

        case = {"schema_version": 1, "kind": "loop",
                "aerodynamics": {"polar": "plate-4pct-channel",
                                 "dynamic": {"type": "network", "name": "lags"}},
                "motion": {"type": "sine", "mean_deg": 2.5, "amplitude_deg": 5,
                           "frequency_c_v": 0.125}}
        use = d.submit(case)
        self.assertEqual(d.wait(use)["state"], "done")
        _, _, summary = d.request("GET", f"/v1/jobs/{use}/summary")
        expected = record["work_network"]["pitch"]
        self.assertAlmostEqual(summary["work"]["pitch"], expected, delta=0.03 * abs(expected))
        self.check_other_polar(d, case)

    def check_other_polar(self, d, case):
        """Refused at the network, unless forced."""
        aero = {**case["aerodynamics"], "polar": "flat-plate-linear"}
        status, _, problem = d.request("POST", "/v1/jobs", {**case, "aerodynamics": aero})
        self.assertEqual(status, 422, problem)
        self.assertEqual([(e["pointer"], e["code"]) for e in problem["errors"]],
                         [("/aerodynamics/dynamic/name", "other_polar")])
        aero["dynamic"] = {**aero["dynamic"], "force": True}
        job = d.submit({**case, "aerodynamics": aero})
        self.assertEqual(d.wait(job)["state"], "done")
        _, _, summary = d.request("GET", f"/v1/jobs/{job}/summary")
        self.assertTrue(summary["identity"]["network_forced"])

    def test_shipped_network(self):
        """Marches the beam of the paper, is part of the answer, and is for its polar only."""
        d = self.start().wait_ready()
        case = simulation()
        plain = d.submit(case)
        case["aerodynamics"]["dynamic"] = {"type": "network", "name": "plate-4pct"}
        job = d.submit(case)
        for one in (plain, job):
            self.assertEqual(d.wait(one)["state"], "done")
        steady, summary = (d.request("GET", f"/v1/jobs/{one}/summary")[2] for one in (plain, job))
        self.assertEqual(summary["identity"]["network"]["name"], "plate-4pct")
        self.assertFalse(summary["identity"]["network_forced"])
        self.assertGreater(abs(summary["means"]["tip_twist_deg"] - steady["means"]["tip_twist_deg"]), 0.01)
        self.check_other_polar(d, case)

    def test_cancel_and_use_of_the_dataset(self):
        d = self.start("--workers", "1").wait_ready()
        d.request("POST", "/v1/datasets", dataset())
        job = d.submit(training(optimiser="adam", epochs=100000, patience=100000, network="long"))
        self.assertEqual(d.request("DELETE", "/v1/datasets/own")[0], 409)
        self.assertEqual(d.request("DELETE", f"/v1/jobs/{job}")[0], 200)
        self.assertEqual(d.wait(job)["state"], "cancelled")
        self.assertEqual(d.request("GET", "/v1/networks/long")[0], 404)
        self.assertEqual(d.request("DELETE", "/v1/datasets/own")[0], 204)

    def test_refusals(self):
        d = self.start().wait_ready()
        d.request("POST", "/v1/datasets", dataset())
        for more, pointer, code in (
                ({"dataset": "none"}, "/training/dataset", "unknown_dataset"),
                ({"dataset": "own@2"}, "/training/dataset", "unknown_dataset"),
                ({"polar": "none"}, "/training/polar", "unknown_polar"),
                ({"network": "a b"}, "/training/network", "bad_name"),
                ({"hidden": 0}, "/training/hidden", "out_of_range"),
                ({"optimiser": "sgd"}, "/training/optimiser", "unknown_value"),
                ({"inputs": ["speed"]}, "/training/inputs/0", "unknown_value"),
                ({"epochs": 1e9}, "/training/epochs", "out_of_range"),
                ({"held_share": 1}, "/training/held_share", "out_of_range"),
                ({"base": "wake"}, "/training/base", "unknown_value"),
                ({"lags_c_v": [2, -1]}, "/training/lags_c_v/1", "out_of_range"),
                ({"inputs": ["alpha", "pitch_rate_lag_1"]}, "/training/inputs/1", "contradiction"),
                ({"hidden": 100, "members": 6}, "/training/members", "out_of_range"),
                ({"layers": 2}, "/training/layers", "unknown_key")):
            with self.subTest(pointer=pointer):
                status, _, problem = d.request("POST", "/v1/jobs", training(**more))
                self.assertEqual(status, 422, problem)
                self.assertEqual([(e["pointer"], e["code"]) for e in problem["errors"]],
                                 [(pointer, code)])
        # An input that never changes is found by the training itself.
        job = d.submit(training(inputs=["alpha_rate", "plunge_rate"]))
        done = d.wait(job)
        self.assertEqual(done["state"], "failed")
        self.assertIn("constant", json.dumps(done["error"]))

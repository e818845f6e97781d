-- Jobs, their queue and their results.
-- Times are microseconds UTC, 0 = not yet. Names of states and kinds are those on the wire.

-- History: one row for each accepted case, never deleted. `seq` is the order of acceptance.
CREATE TABLE job (
    seq          INTEGER PRIMARY KEY,
    id           TEXT    NOT NULL UNIQUE CHECK (length(id) = 36),
    kind         TEXT    NOT NULL,
    state        TEXT    NOT NULL CHECK (state IN
                     ('queued', 'running', 'cancelling', 'done', 'failed', 'cancelled')),
    name         TEXT    NOT NULL,
    content_hash TEXT    NOT NULL,
    attempt      INTEGER NOT NULL DEFAULT 0,  -- claims so far
    created_us   INTEGER NOT NULL,
    started_us   INTEGER NOT NULL DEFAULT 0,  -- of the last claim
    finished_us  INTEGER NOT NULL DEFAULT 0,
    verdict      TEXT    NOT NULL DEFAULT '',
    error_code   TEXT    NOT NULL DEFAULT '',
    error_detail TEXT    NOT NULL DEFAULT ''
) STRICT;

-- Reuse: the one job that answers an equal case. A failed or cancelled one answers nothing.
CREATE UNIQUE INDEX job_reuse ON job (content_hash) WHERE state IN ('queued', 'running', 'done');
-- Lists filtered by state, kind or label, newest first.
CREATE INDEX job_state ON job (state, seq);
CREATE INDEX job_kind ON job (kind, seq);
CREATE INDEX job_name ON job (name, seq) WHERE name <> '';

-- The canonical case; apart from job so that lists read narrow rows.
CREATE TABLE job_case (
    job  INTEGER PRIMARY KEY REFERENCES job (seq),
    json TEXT    NOT NULL
) STRICT;

-- Work to do: one thin row from acceptance to the final state.
CREATE TABLE queue (
    job         INTEGER PRIMARY KEY REFERENCES job (seq),
    ready_us    INTEGER NOT NULL,
    lease_until INTEGER NOT NULL DEFAULT 0,   -- 0 = waiting
    owner       TEXT    NOT NULL DEFAULT '',  -- process that holds the lease
    fence       INTEGER NOT NULL DEFAULT 0,   -- counts claims; a result must carry the last one
    lost        INTEGER NOT NULL DEFAULT 0    -- claims that ended without an answer
) STRICT;
-- Claim: the oldest waiting row; and the leases that ran out.
CREATE INDEX queue_ready ON queue (lease_until, ready_us, job);

-- One row for each finished computation: the proof that it was published once, and by whom.
CREATE TABLE result (
    job         INTEGER PRIMARY KEY REFERENCES job (seq),
    fence       INTEGER NOT NULL,
    finished_us INTEGER NOT NULL,
    cpu_s       REAL    NOT NULL
) STRICT;

-- Result documents as they are served: "summary", "damping", ...
CREATE TABLE document (
    job  INTEGER NOT NULL REFERENCES result (job),
    name TEXT    NOT NULL,
    json TEXT    NOT NULL,
    PRIMARY KEY (job, name)
) STRICT;

-- Recorded series: sample i of each column is at t0 + i * step seconds.
CREATE TABLE series (
    job      INTEGER PRIMARY KEY REFERENCES result (job),
    t0       REAL    NOT NULL,
    step     REAL    NOT NULL,
    n        INTEGER NOT NULL,
    n_column INTEGER NOT NULL
) STRICT;

CREATE TABLE series_column (
    job      INTEGER NOT NULL REFERENCES series (job),
    position INTEGER NOT NULL,
    name     TEXT    NOT NULL,
    PRIMARY KEY (job, position)
) STRICT, WITHOUT ROWID;

-- 4096 samples of one column (server/series.h); checksum is xxh3-64 of the decoded bytes.
CREATE TABLE series_chunk (
    job      INTEGER NOT NULL,
    position INTEGER NOT NULL,
    chunk    INTEGER NOT NULL,
    codec    INTEGER NOT NULL,
    n        INTEGER NOT NULL,
    checksum INTEGER NOT NULL,
    data     BLOB    NOT NULL,
    PRIMARY KEY (job, position, chunk),
    FOREIGN KEY (job, position) REFERENCES series_column (job, position)
) STRICT;

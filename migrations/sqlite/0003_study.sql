-- Studies: jobs whose cells are computed in units by all workers.

-- One row for each study. A study has no row in queue: its units are what waits.
CREATE TABLE study (
    job       INTEGER PRIMARY KEY REFERENCES job (seq),
    n_cell    INTEGER NOT NULL CHECK (n_cell > 0),
    done      INTEGER NOT NULL DEFAULT 0,
    failed    INTEGER NOT NULL DEFAULT 0,
    reused    INTEGER NOT NULL DEFAULT 0,  -- of the done: known before
    cpu_s     REAL    NOT NULL DEFAULT 0,
    fence     INTEGER NOT NULL DEFAULT 0,  -- counts claims of its units
    served_us INTEGER NOT NULL DEFAULT 0,  -- last claim of a unit: whose turn it is
    open      INTEGER NOT NULL DEFAULT 1   -- 0 once the job has a final state
) STRICT;
-- Claim: the open study that was served longest ago; and how many are open.
CREATE INDEX study_open ON study (served_us, job) WHERE open = 1;

-- Work to do: places [next, last) of the order in which the cells are computed. A row goes when it
-- is done, so that what is left is what waits or is leased.
CREATE TABLE study_unit (
    study       INTEGER NOT NULL REFERENCES study (job),
    unit        INTEGER NOT NULL,             -- from 1
    next        INTEGER NOT NULL,
    last        INTEGER NOT NULL,
    lease_until INTEGER NOT NULL DEFAULT 0,   -- 0 = waiting
    owner       TEXT    NOT NULL DEFAULT '',
    fence       INTEGER NOT NULL DEFAULT 0,   -- that of the study at the last claim
    lost        INTEGER NOT NULL DEFAULT 0,   -- claims since `next` moved that ended without an answer
    PRIMARY KEY (study, unit)
) STRICT, WITHOUT ROWID;
-- Claim: the first waiting unit of a study; and the leases that ran out.
CREATE INDEX study_unit_ready ON study_unit (lease_until, study, unit);

-- Answers of cells, shared by the studies that ask for the same.
CREATE TABLE cell_result (
    id           INTEGER PRIMARY KEY,
    content_hash TEXT NOT NULL,               -- '' when the case of the cell is not admissible
    state        TEXT NOT NULL CHECK (state IN ('done', 'failed')),
    verdict      TEXT NOT NULL,
    error_code   TEXT NOT NULL,
    error_detail TEXT NOT NULL,
    cpu_s        REAL NOT NULL,
    size         INTEGER NOT NULL,            -- bytes of the summary document
    summary      BLOB NOT NULL                -- the same, zstd
) STRICT;
-- Reuse: the one answer to an equal case.
CREATE UNIQUE INDEX cell_result_reuse ON cell_result (content_hash) WHERE state = 'done';

-- One row for each finished cell.
CREATE TABLE study_cell (
    study  INTEGER NOT NULL REFERENCES study (job),
    cell   INTEGER NOT NULL,
    result INTEGER NOT NULL REFERENCES cell_result (id),
    reused INTEGER NOT NULL,
    PRIMARY KEY (study, cell)
) STRICT, WITHOUT ROWID;

"""A second validator of URDDs, written from `SPEC.md` and the schemas alone.

    python3 testkit/second_validator DIR       prints findings; 0 accepts, 3 rejects, 2 unreadable
    python3 testkit/second_validator --batch   reads a folder a line, and answers with a line

It knows errors only: warnings and informations (SRC, DIR009, DIR010, DIR013, DIR022, DIR029,
KIN005, LOP012, MSH023, SHP019, SHP020) are not reported. It does not check

- legacy URDDs (section 10): they are unreadable to it, exit status 2;
- LRN010 and LRN011 (8.8.9, 8.8.12), which count 100,000 configurations: a model is not verified;
- of 8.9.4 and 8.9.6, pieces and spheres with very many planes, and more than 2,000 samples: they
  are not verified (8.9.7);
- SHP025 (8.6), which follows from 8.5 and 8.6 where the statistics are right;
- of 8.5, where a matrix has many pairs, all samples: then the first ones alone are judged (13.5);
- LOP009 and LOP010 (6.8.7) in full, where the matrix is large or may be rounding alone, and of
  6.8.8, where there are many, all closed samples (13.5);
- of 2.14, the form of zip archives beyond what Python's `zipfile` refuses;
- of 13.1, the limits of size;
- of 11.1, properties of Unicode in patterns other than general categories.

`mutants.py` switches off its checks in turn and asks whether the conformance suite notices.
"""

//! The codes of all present and past rules. A code is never reused: a removed rule leaves its code in [`RETIRED`].

macro_rules! codes {
    ($($code:ident)*) => {
        /// The code of a rule: a family of three letters, and a number within it.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code { $(#[doc = concat!("See `urdd explain ", stringify!($code), "`.")] $code,)* }

        impl Code {
            /// Every code, family by family in the order of the specification.
            pub const ALL: &[Code] = &[$(Code::$code),*];

            /// The code as text: `DOF003`.
            pub fn as_str(self) -> &'static str {
                match self { $(Code::$code => stringify!($code),)* }
            }
        }
    };
}

codes! {
    DIR001 DIR002 DIR003 DIR004 DIR005 DIR006 DIR007 DIR008 DIR009 DIR010 DIR011 DIR012 DIR013
    DIR014 DIR015 DIR016 DIR017 DIR018 DIR019 DIR020 DIR021 DIR022 DIR023 DIR024 DIR025 DIR026
    DIR027 DIR028 DIR029 DIR030
    JSN001 JSN002 JSN003 JSN004 JSN005 JSN006
    YML001 YML002 YML003 YML004 YML005 YML006 YML007 YML008
    SCH001
    EXT001 EXT002 EXT003 EXT004
    URD001 URD002 URD003 URD004 URD005 URD006 URD007 URD008 URD009 URD010 URD011 URD012 URD013 URD014
    SRC001 SRC002 SRC003 SRC004 SRC005 SRC006 SRC007 SRC008 SRC009
    DOF001 DOF002 DOF003 DOF004 DOF005 DOF006 DOF007
    CHN001 CHN002 CHN003 CHN004 CHN005 CHN006 CHN007 CHN008 CHN009 CHN010
    CON001 CON002 CON003 CON004 CON005 CON006
    BND001 BND002 BND003 BND004 BND005 BND006
    CMP001 CMP002 CMP003 CMP004 CMP005 CMP006
    MSH001 MSH002 MSH003 MSH004 MSH005 MSH006 MSH007 MSH008 MSH009 MSH010 MSH011
    MSH012 MSH013 MSH014 MSH015 MSH016 MSH017 MSH018 MSH019 MSH020 MSH021 MSH022
    MSH023
    SHP001 SHP002 SHP003 SHP004 SHP005 SHP006 SHP007 SHP008 SHP009 SHP010 SHP011 SHP012 SHP013
    SHP014 SHP015 SHP016
    SHP017 SHP018 SHP019 SHP020 SHP021 SHP022 SHP023 SHP024 SHP025
    SHP026 SHP027
    LRN001 LRN002 LRN003 LRN004 LRN005 LRN006 LRN007 LRN008 LRN009 LRN010 LRN011 LRN012
    SPH001 SPH002 SPH003 SPH004 SPH005 SPH006 SPH007 SPH008 SPH009 SPH010 SPH011 SPH012
    KIN001 KIN002 KIN003 KIN004 KIN005
    CNF001 CNF002 CNF003 CNF004
    LOP001 LOP002 LOP003 LOP004 LOP005 LOP006 LOP007 LOP008 LOP009 LOP010 LOP011 LOP012
    LOP013
    LEG001 LEG002 LEG003 LEG004 LEG006 LEG007
    LNT001 LNT002 LNT003 LNT004 LNT005 LNT006 LNT007 LNT008 LNT010 LNT011 LNT012 LNT013 LNT014 LNT015
    LNT016 LNT017 LNT018 LNT020 LNT021 LNT022 LNT023 LNT024 LNT026 LNT027 LNT028 LNT029 LNT030
    LNT031 LNT032 LNT033 LNT034 LNT035 LNT037 LNT040 LNT041 LNT042 LNT043 LNT044 LNT045 LNT046 LNT047
    LNT048 LNT050 LNT051 LNT053 LNT060 LNT061 LNT062 LNT063 LNT064 LNT065 LNT066 LNT067
    TST001 TST002
}

/// A retired code. It is never reused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RetiredCode {
    /// The code as text.
    pub code: &'static str,
    /// Why it was retired.
    pub reason: &'static str,
}

/// Every retired code.
pub const RETIRED: &[RetiredCode] = &[RetiredCode {
    code: "LEG005",
    reason: "it was given up before the first release, and no report ever held it",
}];

impl RetiredCode {
    /// The retired code written as `text`, in upper or lower case.
    pub fn parse(text: &str) -> Option<&'static RetiredCode> {
        RETIRED.iter().find(|retired| retired.code.eq_ignore_ascii_case(text))
    }
}

impl Code {
    /// The code written as `text`, in upper or lower case.
    pub fn parse(text: &str) -> Option<Code> {
        Code::ALL.iter().copied().find(|code| code.as_str().eq_ignore_ascii_case(text))
    }

    /// The three letters of its family.
    pub fn family(self) -> &'static str {
        &self.as_str()[..3]
    }
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.as_str())
    }
}
